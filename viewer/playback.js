// The moment shown, and how it advances.
export class Playback {
  // smooth: may moments between two frames be shown? Otherwise the frame before is shown.
  constructor(times, smooth) {
    this.smooth = smooth;
    this.frame = 0;
    this.time = times[0];
    this.playing = false;
    this.loop = true;
    this.speed = 1;
    this.setTimes(times);
  }
  setTimes(times) {
    this.times = times;
    const span = times[times.length - 1] - times[0];
    // Twenty frames per second, but at least three seconds for the whole run.
    this.rate = span > 0 ? span / Math.max(3, (times.length - 1) / 20) : 1;
  }
  get last() {
    return this.times.length - 1;
  }
  // The number of the last frame at or before a time.
  frameAt(time) {
    let low = 0;
    let high = this.last;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time * (1 + 1e-12)) low = middle;
      else high = middle - 1;
    }
    return low;
  }
  goTo(frame) {
    this.frame = Math.max(0, Math.min(this.last, frame));
    this.time = this.times[this.frame];
  }
  goToTime(time) {
    this.time = Math.max(this.times[0], Math.min(this.times[this.last], time));
    this.frame = this.frameAt(this.time);
  }
  // Goes to the moment of a link. Older links had eight digits, so their times may be a little before the frame.
  goToLink(time) {
    this.goToTime(time);
    const next = this.times[this.frame + 1];
    if (this.times[this.frame] !== time && Number(next?.toPrecision(8)) === time) this.goTo(this.frame + 1);
  }
  // Advances by seconds of real time; at the end it starts again or stops.
  advance(seconds) {
    const next = this.time + seconds * this.rate * this.speed;
    if (next < this.times[this.last] || this.last === 0) this.goToTime(next);
    else if (this.loop && this.frame === this.last) this.goTo(0);
    else {
      this.goTo(this.last);
      this.playing = this.loop;
    }
  }
  // The time of what is shown.
  get shownTime() {
    return this.smooth() ? this.time : this.times[this.frame];
  }
  // The part of the way to the next frame at which the moment shown is, 0 to 1.
  get part() {
    if (!this.smooth()) return 0;
    const from = this.times[this.frame];
    const to = this.times[Math.min(this.last, this.frame + 1)];
    return to > from ? Math.max(0, Math.min(1, (this.time - from) / (to - from))) : 0;
  }
}
