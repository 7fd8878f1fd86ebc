# Makes a manual page of what a program says of itself:
#   PROGRAM --help | awk -v name=PROGRAM -v version=V -v date=D -f man_page.awk > PROGRAM.1
# The lines before `Usage:` are the description, the first one also the name's; `Positionals:` and
# `Options:` hold terms, two spaces in, with their text from column 36 on; what follows is printed
# as it is. CLI11 from 2.5 on has no word `Usage:`, writes headings in capitals, wraps paragraphs
# and leaves blanks at the ends of lines.

function roff(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  gsub(/^\./, "\\\\\\&.", text)
  gsub(/^'/, "\\\\\\&'", text)
  return text
}

# print_term(TERM, TEXT): a term in bold, without what CLI11 says of its kind.
function print_term(term, text) {
  sub(/ REQUIRED$/, "", term)
  print ".TP\n.B " roff(term)
  if (text != "") print roff(text)
}

BEGIN { part = "description" }

{ sub(/ +$/, "") }
part == "description" && (/^Usage: / || index($0 " ", name " ") == 1) {
  usage = $0
  sub(/^Usage: /, "", usage)
  part = "usage"
  next
}
toupper($0) ~ /^(POSITIONALS|OPTIONS|SUBCOMMANDS):$/ {
  part = "terms"
  terms = terms toupper(substr($0, 1, length($0) - 1)) "\n"
  next
}
part == "description" && $0 == "" { next }
part == "description" { description[++described] = $0; next }
/^$/ { if (part == "terms") part = "between"; next }
part == "terms" { terms = terms $0 "\n"; next }
part != "usage" { part = "end"; last = last $0 "\n" }

END {
  if (usage == "" || described == 0) {
    print "man_page.awk: " name " --help has no description and usage" > "/dev/stderr"
    exit 1
  }
  # A wrapped first sentence is one line again.
  brief = description[1]
  while (brief !~ /\.$/ && first < described - 1) brief = brief " " description[++first + 1]
  sub(/\.$/, "", brief)
  print ".TH " toupper(roff(name)) " 1 \"" date "\" \"mrpt_polyloc " version "\" \"User Commands\""
  print ".SH NAME\n" roff(name) " \\- " roff(tolower(substr(brief, 1, 1)) substr(brief, 2))
  print ".SH SYNOPSIS\n.B " roff(usage)
  print ".SH DESCRIPTION"
  for (i = 1; i <= described; ++i) print roff(description[i])
  count = split(terms, line, "\n")
  for (i = 1; i < count; ++i) {
    if (line[i] ~ /^[A-Z]+$/) {
      print ".SH " line[i]
    } else if (line[i] ~ /^ {20,}/) { # the text of a term that is too long for its column
      sub(/^ +/, "", line[i])
      print roff(line[i])
    } else {
      sub(/^ +/, "", line[i])
      if (line[i] ~ /^-[A-Za-z], +--/) sub(/, +/, ",", line[i])
      at = match(line[i], /   */)
      print_term(at ? substr(line[i], 1, at - 1) : line[i],
                 at ? substr(line[i], at + RLENGTH) : "")
    }
  }
  if (last != "") {
    print ".SH NOTES\n.nf"
    count = split(last, line, "\n")
    for (i = 1; i < count; ++i) print roff(line[i])
    print ".fi"
  }
  print ".SH EXIT STATUS"
  print "0 done; 1 the input or the job failed (the message names file and place); 2 wrong usage."
  print ".SH SEE ALSO\nThe documentation of the package: README.md and the pages of mrpt_polyloc/doc."
}
