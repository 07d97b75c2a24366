export function goLive() {}
