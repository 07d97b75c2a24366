// The keyboard. Fields keep the keys that they know.

import { $ } from './bar.js';

const VIEWS = { 1: 'corner', 2: 'front', 3: 'side', 4: 'top' };

export function listen(page) {
  const { clock, bar } = page;
  const actions = {
    ' ': () => clock.toggle(),
    ArrowLeft: (shift) => (shift ? bar.jump(-1) : bar.frame(-1)),
    ArrowRight: (shift) => (shift ? bar.jump(1) : bar.frame(1)),
    Home: () => clock.seek(clock.start),
    End: () => clock.seek(clock.end),
    '[': () => clock.faster(-1),
    ']': () => clock.faster(1),
    f: () => page.look(null),
    c: () => page.nextBodies(),
    n: () => $('show-names').click(),
    t: () => page.otherTheme(),
    p: () => page.openPanel(document.body.classList.contains('closed')),
  };
  window.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tagName, type } = event.target;
    if (tagName === 'SELECT' || (tagName === 'INPUT' && type !== 'checkbox' && !isTime(event))) return;
    if (event.key === ' ' && (tagName === 'BUTTON' || tagName === 'INPUT') && !isTime(event)) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = actions[key] ?? (VIEWS[key] && (() => page.look(VIEWS[key])));
    if (!action) return;
    event.preventDefault();
    action(event.shiftKey);
  });
}

const isTime = (event) => event.target.id === 'time';
