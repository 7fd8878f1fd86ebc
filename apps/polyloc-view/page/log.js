// Scrubbing through a log: a slider, play and stop, and what became of each scan looked at.

import * as api from './api.js';

const $ = (id) => document.getElementById(id);
const kPause = 120; // ms between scans that are played

export class LogPlayer {
  // act: {row(), setRow(row), search(), hint(words)}
  constructor(act) {
    this.act = act;
    this.count = 0;
    this.hasTruth = false;
    this.outcomes = new Map(); // row -> {outcome, pose}
    this.path = [];
    this.isPlaying = false;
    $('log-row').addEventListener('input', () => this.go(Number($('log-row').value)));
    $('log-play').addEventListener('click', () => this.toggle());
    $('log-miss').addEventListener('click', () => this.nextMiss());
    $('log-leave').addEventListener('click', () => this.leave());
  }
  async begin() {
    const log = await api.get('log');
    this.count = log.count;
    this.hasTruth = log.truth;
    this.path = log.path;
    if (!this.count) return;
    $('log').hidden = false;
    $('log-row').max = this.count - 1;
    $('log-miss').title = this.hasTruth
      ? 'Next scan whose first answer is not right (n)'
      : 'Next scan whose answer is not unique (n)';
    this.show();
  }
  get row() {
    return this.act.row();
  }
  get isOn() {
    return this.count > 0 && this.row >= 0;
  }
  go(row) {
    if (this.count) this.act.setRow(Math.min(Math.max(row, 0), this.count - 1));
  }
  step(by) {
    this.go(this.isOn ? this.row + by : 0);
  }
  leave() {
    this.stop();
    this.act.setRow(-1);
  }
  // Called with each answer to a row.
  answered(answer) {
    const { row, result, truth } = answer;
    const first = result.hypotheses[0];
    const pose = first && { x: first.x, y: first.y, phi: first.phi };
    let outcome = result.status;
    if (this.hasTruth && first) outcome = isRight(first, truth) ? 'right' : 'wrong';
    this.outcomes.set(row, { outcome, pose });
    this.show();
    if (this.isPlaying) {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.advance(), kPause);
    }
  }
  show() {
    const on = this.isOn;
    const { outcome } = this.outcomes.get(this.row) ?? {};
    if (on) $('log-row').value = this.row;
    $('log-text').textContent = on ? `scan ${this.row} of ${this.count}${outcome ? ` · ${outcome.replace(/_/g, ' ')}` : ''}` : `${this.count} scans`;
    $('log-leave').hidden = !on;
    $('log-play').textContent = this.isPlaying ? '❚❚' : '▶';
    $('log-play').setAttribute('aria-label', this.isPlaying ? 'Stop' : 'Play');
  }
  toggle() {
    if (!this.count) return;
    if (this.isPlaying) return this.stop();
    this.isPlaying = true;
    this.step(this.row >= this.count - 1 ? -this.count : 1);
    this.show();
  }
  stop() {
    this.isPlaying = false;
    clearTimeout(this.timer);
    this.show();
  }
  advance() {
    if (!this.isPlaying) return;
    if (this.row >= this.count - 1) this.stop();
    else this.step(1);
  }
  // Looks for it on the server, half a second's worth of scans at a time.
  async nextMiss() {
    if (!this.count || this.isSearching) return;
    this.stop();
    this.isSearching = true;
    try {
      let next = this.isOn ? this.row + 1 : 0;
      while (next !== null && next < this.count) {
        this.act.hint(`looking from scan ${next}…`);
        const answer = await api.post('outcomes', 'outcomes', { first: next, count: 1000, stop_at_miss: true, search: this.act.search() });
        if (!answer) return;
        for (const { row, outcome, pose } of answer.outcomes) this.outcomes.set(row, { outcome, pose });
        if (answer.miss !== null) {
          this.act.hint('');
          return this.go(answer.miss);
        }
        next = answer.next;
      }
      this.act.hint('no further miss');
    } finally {
      this.isSearching = false;
    }
  }
  // Outcomes so far as the scene takes them.
  dots() {
    const dots = {};
    for (const { outcome, pose } of this.outcomes.values()) {
      if (pose) (dots[outcome] ??= []).push(pose.x, pose.y);
    }
    return dots;
  }
  forget() {
    this.outcomes.clear();
  }
}

// Within 0.3 m and 5 degrees, as everywhere.
function isRight(pose, truth) {
  const turn = Math.atan2(Math.sin(pose.phi - truth.phi), Math.cos(pose.phi - truth.phi));
  return Math.hypot(pose.x - truth.x, pose.y - truth.y) <= 0.3 && Math.abs(turn) <= (5 * Math.PI) / 180;
}
