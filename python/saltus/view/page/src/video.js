// A video of the scene, made in the page: VP9 in WebM.

import { ArrayBufferTarget, Muxer } from 'webm-muxer';

const CODECS = [
  ['vp09.00.41.08', 'V_VP9'],
  ['vp8', 'V_VP8'],
];
const WAITING = 4; // frames that the encoder may have in hand
const KEY = 2; // s of video between frames that stand for themselves

// Times of the frames: frame k is the page at start + k / (rate slow).
export function frameTimes(start, end, rate, slow) {
  const count = Math.floor((end - start) * rate * slow + 1e-6) + 1;
  return Array.from({ length: count }, (_, k) => start + k / (rate * slow));
}

// options: { rate, slow, width, height }; returns a Blob.
export async function makeVideo(page, options, progress = () => {}) {
  if (typeof VideoEncoder === 'undefined') {
    throw new Error('This browser has no video encoder (WebCodecs); Chromium has one.');
  }
  const { rate, slow } = options;
  const [width, height] = [options.width, options.height].map((x) => Math.max(2, 2 * Math.round(x / 2)));
  const times = frameTimes(page.clock.start, page.clock.end, rate, slow);
  const [codec, mark] = await codecFor(width, height, rate);
  const target = new ArrayBufferTarget();
  const muxer = new Muxer({ target, video: { codec: mark, width, height, frameRate: rate } });
  let failure = null;
  const encoder = new VideoEncoder({
    output: (chunk, meta) => muxer.addVideoChunk(chunk, meta),
    error: (error) => (failure = error),
  });
  encoder.configure({ codec, width, height, framerate: rate, bitrate: bitrate(width, height, rate) });
  page.beginVideo([width, height], 1 / slow);
  try {
    for (let k = 0; k < times.length && !failure; k++) {
      page.clock.time = times[k];
      page.render();
      const frame = new VideoFrame(page.stage.canvas, {
        timestamp: Math.round((1e6 * k) / rate),
        duration: Math.round(1e6 / rate),
      });
      encoder.encode(frame, { keyFrame: k % Math.max(1, Math.round(KEY * rate)) === 0 });
      frame.close();
      progress((k + 1) / times.length);
      // Lets the encoder and the page come to their turn.
      do await new Promise((done) => setTimeout(done, 0));
      while (encoder.encodeQueueSize > WAITING && !failure);
    }
    if (!failure) await encoder.flush();
  } finally {
    page.endVideo();
  }
  if (failure) throw failure;
  muxer.finalize();
  return new Blob([target.buffer], { type: 'video/webm' });
}

function bitrate(width, height, rate) {
  return Math.round(Math.min(Math.max(0.14 * width * height * rate, 1e6), 2e7));
}

async function codecFor(width, height, framerate) {
  for (const [codec, mark] of CODECS) {
    const config = { codec, width, height, framerate, bitrate: bitrate(width, height, framerate) };
    const { supported } = await VideoEncoder.isConfigSupported(config);
    if (supported) return [codec, mark];
  }
  throw new Error(`This browser encodes no video of ${width} x ${height} (VP9, VP8).`);
}
