#!/usr/bin/env bash
# The gate's count sees what fails inside a process, and a process that fails without saying where.
set -euo pipefail
count=$1 # tests/count_results.py
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir "$root/own"

# expect WANTED TESTCASE...: what is counted of ctest's report of these.
expect() {
  local wanted=$1 counted
  shift
  printf '<testsuite>%s</testsuite>' "$*" > "$root/ctest.xml"
  counted=$(python3 "$count" "$root/ctest.xml" "$root/own" 2> "$root/error") || counted=refused
  [ "$counted" = "$wanted" ] || {
    echo "counted '$counted', not '$wanted', of: $*"
    exit 1
  }
}
passed='<testcase name="a" status="run"/>'
failed='<testcase name="b" status="fail"/>'
expect "1 1 1" "$passed" "$failed" '<testcase name="c" status="notrun"><skipped/></testcase>'
expect refused ""
cat > "$root/own/b.xml" << 'XML'
<testsuites><testsuite>
  <testcase name="x" status="run"/>
  <testcase name="y" status="run"><failure/></testcase>
  <testcase name="z" status="run"><skipped/></testcase>
  <testcase name="w" status="notrun"/>
</testsuite></testsuites>
XML
expect "1 1 2" "$failed"
# All of its tests passed, and then the process failed, as by a sanitizer at its end.
printf '<testsuites><testsuite><testcase name="x" status="run"/></testsuite></testsuites>' \
  > "$root/own/b.xml"
expect "1 1 0" "$failed"
expect "2 0 0" "$passed" '<testcase name="b" status="run"/>'
# It crashed: no report of its own.
rm "$root/own/b.xml"
expect "0 1 0" "$failed"
