#!/usr/bin/env bash
# report_test.sh PROGRAMS: makes a report and opens it in a headless Chromium at the width of a desk
# and of a phone: no script error, every picture drawn, nothing wider than the window, tables sort.
# Exits 77 (skipped) without Chromium.
set -euo pipefail
programs=$1
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
[ -n "$browser" ] || { echo "no Chromium is here"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat > room.wkt <<'WKT'
POLYGON ((0 0, 8 0, 8 3, 6 3, 6 5, 2.5 5, 2.5 6.2, 1 6.2, 1 5, 0 5, 0 0), (4 1, 4 2.2, 5.5 1.6, 4 1))
WKT
cat > list.yaml <<'YAML'
datasets:
  - {name: narrow, map: room.wkt, simulate: {n: 30, seed: 1, fov: 60, short: 0.5}}
  - {name: a-name-that-is-much-longer-than-any-column-of-a-table-should-be-wide-yet-allowed, map: room.wkt, simulate: {n: 5, seed: 2}}
methods: [certified, correlative]
YAML
"$programs/polyloc-eval" list.yaml -o out > /dev/null

# Put before the page's own script, it hears its errors; at the end it writes what it saw into the
# page, which Chromium prints. Headless windows are at least 500 pixels wide: the page is put into
# a root of the width that is to be tried.
cat > head.html <<'HTML'
<script>
const seen = [];
addEventListener('error', event => seen.push('error: ' + event.message));
addEventListener('unhandledrejection', event => seen.push('error: ' + event.reason));
</script>
HTML
cat > tail.html <<'HTML'
<script>
const width = WIDTH;
if (document.body.dataset.ready !== 'yes') seen.push('the page is not ready');
for (const node of document.querySelectorAll('body *')) {
  if (node.closest('.scroll table') || node.closest('svg g') || node.closest('defs')) continue;
  const box = node.getBoundingClientRect();
  if (box.right > width + 1) seen.push('too wide: ' + node.outerHTML.slice(0, 90));
}
const check = what => document.querySelectorAll('svg').forEach(svg => {
  const box = svg.getBoundingClientRect();
  if (!(box.width > 10 && box.height > 5) || svg.querySelectorAll('path, circle').length === 0 ||
      /NaN|undefined|Infinity/.test(svg.outerHTML)) seen.push('not drawn ' + what + ': ' + svg.outerHTML.slice(0, 300));
});
check('at first');
document.querySelectorAll('button').forEach(button => { button.click(); check('after ' + button.textContent); });
const select = document.getElementById('curveset');
select.value = 1; select.dispatchEvent(new Event('change')); check('of one set');
const column = [...document.querySelectorAll('#table tbody tr')].map(row => row.cells[2].textContent);
document.querySelectorAll('#table thead button')[2].click();
const sorted = [...document.querySelectorAll('#table tbody tr')].map(row => +row.cells[2].textContent);
if (column.length !== 4 || sorted.some((v, i) => i && v > sorted[i - 1])) seen.push('does not sort');
if (document.querySelectorAll('#maps svg').length !== 2) seen.push('maps are missing');
if (document.querySelectorAll('#misses figure').length === 0) seen.push('misses are missing');
setTimeout(() => document.documentElement.append(Object.assign(document.createElement('pre'),  // late errors, too
  {textContent: 'VERDICT ' + (seen.join(' | ') || 'fine')})), 300);
</script>
HTML
failed=0
for width in 1280 400; do
  {
    sed -n '1,/<meta charset/p' out/report.html
    cat head.html
    sed '1,/<meta charset/d; /<\/body>/,$d' out/report.html
    sed "s/WIDTH/$width/" tail.html
    echo "<style>html { width: ${width}px; }</style></body></html>"
  } > page.html
  # The width must hold before the scripts run.
  sed -i "s#<style>#<style>html { width: ${width}px; }\n#" page.html
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --window-size="$((width < 500 ? 500 : width)),900" \
    --virtual-time-budget=10000 --dump-dom "file://$work/page.html" > dom.html 2> browser.log || true
  verdict=$(grep -o 'VERDICT [^<]*' dom.html | tail -n 1 || true)
  echo "$width pixels: ${verdict:-no verdict}"
  [ "$verdict" = "VERDICT fine" ] || failed=1
done
exit $failed
