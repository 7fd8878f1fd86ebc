// The paper in five steps, on the niches map.

const steps = [
  {
    title: '1 · One scan, where am I?',
    text: 'A robot wakes up in a building that it has a map of, and takes one laser scan (the dots). Drag it through the hall, turn it by its handle or with Q and E: the green arrow is the pose that explains the scan, found from the scan alone.',
    set: { x: 16.5, y: 2, deg: 150, show: 'scan,beams,hypotheses', method: 'certified', sel: 0 },
  },
  {
    title: '2 · Some places look alike',
    text: 'Deep in an outer niche the same is seen as in its twin nine metres beside it. No method can tell them apart, and an honest one says so: two hypotheses, each with its weight. That is the localization problem as Guibas, Motwani and Raghavan put it: list every pose. "Where to drive?" shows how a robot finds out: it drives where both let it, and looks again.',
    set: { x: 4.5, y: -3.25, deg: 90, show: 'scan,beams,hypotheses', method: 'certified', sel: 0 },
  },
  {
    title: '3 · Visibility cells',
    text: 'Lines through two corners cut the hall into cells. Inside a cell the same corners are seen in the same order, so that its skeleton (orange) is one and the same; crossing a line, a corner comes into sight or is lost. Without noise it is enough to look the skeleton up: the method "exact".',
    set: { x: 11, y: 1.6, deg: 90, show: 'hypotheses,cells,segments,view,skeleton', method: 'exact', sel: 0 },
  },
  {
    title: '4 · With noise: compare polar functions',
    text: 'Real scans never fit exactly. Karch, Noltemeier, Schwark and Wahl compare what is seen as functions of direction, and take the area between them for a distance, under the best rotation. Here are both: measured (dots) and predicted (line) at the chosen hypothesis.',
    set: { x: 9, y: 3, deg: 60, sigma: 5, show: 'scan,predicted,hypotheses,polar', method: 'certified', sel: 0 },
  },
  {
    title: '5 · Nothing overlooked',
    text: 'The search here bounds what is seen from small leaves of the map (the shaded band holds every range that is seen from anywhere in this one) and throws away all that cannot fit. What it could not exclude is what you see in green: the certificate. Now drop objects, move walls, drag the robot, and see when it starts to doubt.',
    set: { x: 9, y: 3, deg: 60, sigma: 3, show: 'scan,hypotheses,regions,bands', method: 'certified', sel: 0 },
  },
];

const $ = (id) => document.getElementById(id);

export class Tour {
  // act: {set(state), fits(): whether the map is that of the tour, done()}
  constructor(act) {
    this.act = act;
    this.at = -1;
    $('tour-next').addEventListener('click', () => this.go(this.at + 1));
    $('tour-back').addEventListener('click', () => this.go(this.at - 1));
    $('tour-end').addEventListener('click', () => this.end());
  }
  get isOpen() {
    return this.at >= 0;
  }
  go(step) {
    if (step < 0) return;
    if (step >= steps.length) return this.end();
    this.at = step;
    const { title, text, set } = steps[step];
    $('tour').hidden = false;
    $('tour-title').textContent = title;
    $('tour-text').textContent = text;
    $('tour-step').textContent = `${step + 1} of ${steps.length}`;
    $('tour-back').disabled = step === 0;
    $('tour-next').textContent = step + 1 === steps.length ? 'done' : 'next';
    this.act.set(set);
  }
  end() {
    this.at = -1;
    $('tour').hidden = true;
    try {
      localStorage.setItem('polyloc-tour', 'seen');
    } catch {
      // no storage: the tour comes again
    }
  }
  static wasSeen() {
    try {
      return localStorage.getItem('polyloc-tour') === 'seen';
    } catch {
      return false;
    }
  }
}
