// Time on the page: plays by the wall clock at a speed, stops at the end or begins again.

export const SPEEDS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];

// s that two times of one instant may differ by: of impacts, and of rounding of large times.
export const sameInstant = (time) => 1e-9 + 4e-16 * Math.abs(time);

export class Clock {
  constructor(start, end) {
    this.start = start;
    this.end = end;
    this.time = start;
    this.speed = 1;
    this.playing = false;
    this.loop = false;
    this.last = null; // ms of the frame before
    this.changed = () => {};
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.start), this.end);
    this.changed();
  }

  play() {
    if (this.end <= this.start) return;
    if (this.time >= this.end) this.time = this.start;
    this.playing = true;
    this.last = null;
    this.changed();
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.changed();
  }

  faster(steps) {
    const nearest = SPEEDS.findIndex((speed) => speed >= this.speed - 1e-9);
    const next = Math.min(Math.max(nearest + steps, 0), SPEEDS.length - 1);
    this.setSpeed(SPEEDS[next]);
  }

  // Goes on to the frame at `now` [ms]; true if time passed.
  tick(now) {
    if (!this.playing) return false;
    const passed = this.last === null ? 0 : (now - this.last) / 1000;
    this.last = now;
    this.time += passed * this.speed;
    if (this.time >= this.end) {
      if (this.loop) {
        this.time = this.start + ((this.time - this.start) % (this.end - this.start));
      } else {
        this.time = this.end;
        this.playing = false;
        this.changed();
      }
    }
    return true;
  }
}
