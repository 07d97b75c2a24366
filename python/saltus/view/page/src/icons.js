// Pictures on buttons; fonts may lack such signs.

const svg = (path) => `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${path}"/></svg>`;

export const ICONS = {
  play: svg('M7 4.5v15l12.5-7.5z'),
  pause: svg('M6 4.5h4.2v15H6zM13.8 4.5H18v15h-4.2z'),
  next: svg('M5 5v14l9-7zM15.5 5h3v14h-3z'),
  previous: svg('M19 5v14l-9-7zM5.5 5h3v14h-3z'),
  menu: svg('M4 6h10v2H4zM4 11h10v2H4zM4 16h10v2H4zM17 5h3v14h-3z'),
  theme: svg('M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zm0 2.2v13.6a6.8 6.8 0 0 1 0-13.6z'),
};
