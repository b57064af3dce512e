// The time shown by all players and histories of a page.

class Clock {
  /** `times` of the frames in s, ascending. */
  constructor(times) {
    this.times = times;
    this.index = 0;
    this.rate = 20;  // frames per second
    this.playing = false;
    this.listeners = [];
  }

  get time() { return this.times[this.index] ?? 0; }
  get last() { return Math.max(this.times.length - 1, 0); }

  listen(listener) {
    this.listeners.push(listener);
    listener(this);
  }
  tell() {
    for (const listener of this.listeners) listener(this);
  }

  go(index) {
    this.index = Math.min(Math.max(index, 0), this.last);
    this.tell();
  }

  /** Stops at the frame nearest to `time`. */
  go_near(time) {
    let index = 0;
    while (index < this.last && Math.abs(this.times[index + 1] - time) <= Math.abs(this.times[index] - time))
      ++index;
    this.stop_at(index);
  }

  /** Stops at the first frame at or after `time`. */
  go_to(time) {
    const index = this.times.findIndex((t) => t >= time * (1 - 1e-9));
    this.stop_at(index < 0 ? this.last : index);
  }

  stop_at(index) {
    this.playing = false;
    this.go(index);
  }

  play(on = !this.playing) {
    this.playing = on && this.last > 0;
    if (this.playing && this.index === this.last) this.index = 0;
    this.tell();
    if (!this.playing) return;
    let shown = performance.now();
    const turn = (now) => {
      if (!this.playing) return;
      const frames = Math.floor((now - shown) * this.rate / 1000);
      if (frames > 0) {
        shown += frames * 1000 / this.rate;
        if (this.index + frames >= this.last) this.playing = false;
        this.go(this.index + frames);
      }
      requestAnimationFrame(turn);
    };
    requestAnimationFrame(turn);
  }
}

/** Clock with the times of all frames or, without frames, of all histories. */
function clock_of(runs) {
  const of_run = (run) =>
      run.frames.length ? run.frames.map((frame, k) => frame.t ?? k) : column_of(run, 't')?.values ?? [];
  const drawn = runs.filter((run) => run.frames.length);
  const all = (drawn.length ? drawn : runs).flatMap(of_run).sort((a, b) => a - b);
  const times = all.filter((t, k) => k === 0 || t - all[k - 1] > 1e-9 * Math.abs(t));
  return new Clock(times.length ? times : [0]);
}
