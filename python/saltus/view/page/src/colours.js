// Colours that the colour-blind tell apart, after Paul Tol and Okabe and Ito, for light and dark.

export const BODIES = ['#4477aa', '#ccbb44', '#66ccee', '#228833', '#aa7fb8', '#e0925f', '#7b8794'];
export const FIXED = '#a3aab3';
export const ARROWS = { impulse: '#e8481c', force: '#7a2fd0', normal: '#0b8f6a' };
export const AXES = ['#d55e00', '#009e73', '#0072b2'];

export const THEMES = {
  light: {
    sky: '#f3f5f8',
    floor: '#e3e7ec',
    wall: '#c3d2e2',
    grid: '#8b97a5',
    thread: '#525c68',
    text: '#1c2430',
    faint: '#66707d',
    curves: ['#0072b2', '#c76a00', '#1c2430'],
    sun: 2.2,
    ambient: 1.35,
    shade: '#c4ccd6',
  },
  dark: {
    sky: '#14181d',
    floor: '#222932',
    wall: '#2c4159',
    grid: '#5c6a7a',
    thread: '#aeb8c4',
    text: '#e8edf3',
    faint: '#9aa6b4',
    curves: ['#56b4e9', '#e69f00', '#e8edf3'],
    sun: 2.4,
    ambient: 0.95,
    shade: '#3a4552',
  },
};
