// The second stage: a simulated robot that drives until it knows where it is, a step at a time.
// Which step is seen is a part of the state; the server makes the steps, the same ones each time.

import * as api from './api.js';

const $ = (id) => document.getElementById(id);
const kPause = 700; // ms between steps on the way to the end
export const kMostSteps = 200;

export class Travel {
  // act: {step(), setStep(step), may(): why there can be no drive, or ''; hint(words)}
  constructor(act) {
    this.act = act;
    this.drive = null; // the last answer
    this.isRunning = false;
    const press = {
      'travel-plan': () => this.go(), 'travel-go': () => this.go(), 'travel-back': () => this.back(),
      'travel-run': () => this.toggle(), 'travel-leave': () => this.leave(),
    };
    for (const [id, act] of Object.entries(press)) $(id).addEventListener('click', act);
  }
  get step() {
    return this.act.step();
  }
  get isOn() {
    return this.step >= 0;
  }
  get isOver() {
    return Boolean(this.drive && this.drive.outcome !== null && this.drive.step <= this.step);
  }
  async question(request) {
    const answer = await api.post('answer', 'travel', { ...request, step: this.step });
    return answer && { ...answer, drive: answer };
  }
  // The first press plans, each further one drives.
  go() {
    const why = this.act.may();
    if (why) return this.act.hint(why);
    if (!this.isOn) return this.act.setStep(0);
    if (this.isOver) return this.stop();
    if (this.drive?.step === this.step) this.act.setStep(Math.min(this.step + 1, kMostSteps));
  }
  back() {
    this.stop();
    if (this.step > 0) this.act.setStep(this.step - 1);
  }
  leave() {
    this.stop();
    if (this.isOn) this.act.setStep(-1);
  }
  toggle() {
    if (this.isRunning) return this.stop();
    if (this.isOver) return;
    this.isRunning = true;
    this.go();
    this.show();
    if (!this.isOn) this.isRunning = false;
  }
  stop() {
    this.isRunning = false;
    clearTimeout(this.timer);
    this.show();
  }
  // Called with each answer.
  answered(answer) {
    this.drive = answer.drive;
    if (this.drive.step < this.step) this.act.setStep(this.drive.step); // the address said too much
    if (this.isRunning) {
      clearTimeout(this.timer);
      if (this.isOver) this.isRunning = false;
      else this.timer = setTimeout(() => this.isRunning && this.go(), kPause);
    }
    this.show();
  }
  failed() {
    this.drive = null;
    this.stop();
  }
  show() {
    const on = this.isOn;
    $('travel').hidden = !on;
    if (!on) this.drive = null;
    $('travel-back').disabled = this.step <= 0;
    $('travel-go').disabled = this.isOver;
    $('travel-run').disabled = this.isOver;
    $('travel-run').textContent = this.isRunning ? '❚❚' : '▶';
    $('travel-run').setAttribute('aria-label', this.isRunning ? 'Stop' : 'Drive to the end');
    const isThere = this.drive && (this.drive.step === this.step || this.isOver);
    const words = !on ? '' : isThere ? wordsOf(this.drive) : 'Drives, looks, plans…';
    if ($('travel-text').textContent !== words) $('travel-text').textContent = words;
  }
}

const metres = (m) => (m < 0.095 ? `${(100 * m).toFixed(0)} cm` : `${m.toFixed(1)} m`);
const many = (n, one) => `${n} ${one}${n === 1 ? '' : 's'}`;

// What a drive has come to, in a sentence or two.
export function wordsOf(drive) {
  return sentencesOf(drive).replace(/(\d) (%|m\b|cm\b|scan)/g, '$1\u00a0$2');
}

function sentencesOf(drive) {
  const { plan, outcome, travelled, scans, error, collisions } = drive;
  const far = `${metres(travelled)}, ${many(scans, 'scan')}${collisions ? `, touched something ${many(collisions, 'time')}` : ''}`;
  const off = error.m === null ? '' : `${metres(error.m)}, ${((error.rad * 180) / Math.PI).toFixed(1)}° off`;
  if (outcome === 'localized') return `Known for sure, and right (${off}): ${far}.`;
  if (outcome === 'wrong') return `Sure, and wrong (${off}): ${far}.`;
  if (outcome === 'indistinguishable') return `Nothing within reach tells these places apart: ${far}.`;
  if (outcome === 'gave_up') {
    const why = plan?.status === 'blocked' ? 'it cannot leave its place' : 'it has driven or looked enough';
    return `Gave up, ${why}: ${far}.`;
  }
  if (plan?.status === 'go') return `${planOf(plan)} So far ${far}.`;
  return `It cannot move: something stands within its radius. It looks again. So far ${far}.`;
}

function planOf(plan) {
  const turns = plan.way.length < 2;
  const leg = turns ? 'Turn first' : `Drive ${metres(lengthOf(plan.way))} to the ring`;
  if (!(plan.value > 0)) return `${leg}, to see something new: no place in reach is known to tell.`;
  const goal = plan.distance > 0 ? `the scan at the diamond, ${metres(plan.distance)} away,` : 'the next scan here';
  return `${leg}; ${goal} shall tell ${(100 * plan.value).toFixed(0)} % of the pairs apart.`;
}

function lengthOf(way) {
  let length = 0;
  for (let i = 1; i < way.length; ++i) length += Math.hypot(way[i].x - way[i - 1].x, way[i].y - way[i - 1].y);
  return length;
}
