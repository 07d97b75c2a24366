// Where the page begins: unpacks its data, builds the page, says in words what fails.

import { unpackAll } from './decode.js';
import { goLive } from './live.js';
import { Page } from './page.js';
import { doJob, offerToSave } from './save.js';
import { makeVideo } from './video.js';
import style from './style.css';
import body from './page.html';

// What programs ask the page; tests do.
function answers(page) {
  const shapes = page.items.all.filter((item) => item.kind === 'collision' && item.mesh);
  const { origin } = page.data; // places on the page are relative to it, in answers they are not
  const inWorld = (at) => at.map((x, k) => (k < 3 ? x + origin[k] : x));
  return {
    page,
    get time() {
      return page.clock.time;
    },
    seek(time) {
      page.clock.pause();
      page.clock.seek(time);
      page.dirty = false;
      page.render();
      page.bar.place();
      page.panel.place();
    },
    poses: () => shapes.map((item) => [item.name, inWorld(page.items.poseOf(item, page.motion.now))]),
    arrows: () => page.arrows.now.map((arrow) => ({ ...arrow, point: inWorld(arrow.point) })),
    project: (point) => page.project(point.map((x, k) => x - origin[k])),
    calls: () => page.stage.renderer.info.render.calls,
    video: (options) => makeVideo(page, options),
  };
}

async function stored() {
  return unpackAll(JSON.parse(document.getElementById('saltus-data').textContent));
}

async function start() {
  const element = document.createElement('style');
  element.textContent = style;
  document.head.append(element);
  const data = await stored().catch((error) => {
    throw new Error(`The data of this page are damaged: ${error.message}`, { cause: error });
  });
  document.body.innerHTML = body;
  const page = new Page(data);
  offerToSave(page);
  if (data.mode === 'live') goLive(page);
  const own = answers(page);
  if (data.job) doJob(page, data.job);
  return own;
}

window.saltus = { ready: start() };
window.saltus.ready.then(
  (own) => Object.defineProperties(window.saltus, Object.getOwnPropertyDescriptors(own)),
  (error) => {
    const text = document.createElement('p');
    text.className = 'problem';
    text.setAttribute('role', 'alert');
    text.textContent = error.message;
    document.body.replaceChildren(text);
    console.error(error);
  },
);
