// Pictures and videos that the page saves.

import { $ } from './bar.js';
import { makeVideo } from './video.js';

const HEARTBEAT = 5000; // ms between words that a frame was made

function download(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export function offerToSave(page) {
  const name = page.data.title.replace(/[^\w.-]+/g, '_') || 'run';
  $('save-picture').onclick = () => {
    page.render();
    page.stage.canvas.toBlob((blob) => download(blob, `${name}.png`));
  };
  const button = $('save-video');
  button.disabled = typeof VideoEncoder === 'undefined' || page.clock.end <= page.clock.start;
  if (typeof VideoEncoder === 'undefined') button.title = 'This browser has no video encoder.';
  button.onclick = async () => {
    const { clientWidth: width, clientHeight: height } = page.stage.canvas;
    const options = { rate: 30, slow: 1 / page.clock.speed, width, height };
    button.disabled = true;
    try {
      const tell = (part) => page.say(`Video: ${Math.round(100 * part)} %`);
      download(await makeVideo(page, options, tell), `${name}.webm`);
    } catch (error) {
      page.say(error.message);
    } finally {
      button.disabled = false;
    }
  };
}

// A video that a program asked for: made at once and sent where the data say.
export async function doJob(page, job) {
  const send = (what, body) => fetch(`${job.url}/${what}`, { method: 'POST', body });
  try {
    document.body.classList.add('bare');
    page.stage.sun.castShadow = true; // whatever it takes
    page.setTheme(job.theme);
    page.look(job.view);
    if (job.follow !== null) page.follow(job.follow);
    let last = 0;
    const blob = await makeVideo(page, job, (part) => {
      if (performance.now() < last + HEARTBEAT) return;
      last = performance.now();
      send('progress', String(part));
    });
    await send('video', blob);
  } catch (error) {
    await send('problem', error.message);
  }
}
