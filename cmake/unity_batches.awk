# Divides source files into batches that compile as one file each. Prints "BATCH FILE", a line for
# each file; batch 0 holds those that must compile alone.
#
#   awk -v max_lines=N -f unity_batches.awk FILE...
#
# A file joins the first batch with room where it mentions no name that an earlier file of the batch
# defines for itself (in an anonymous namespace, or as static): neither twice defined nor another
# meaning than alone. Files that define macros or open a namespace for all that follows stay alone:
# Highway's, which include themselves for each instruction set, among them.

function starts_file() {
  close_file()
  file = FILENAME
  split("", defined)
  split("", used)
  lines = 0
  alone = anonymous = 0
}

function define(name) {
  if (name ~ /^[A-Za-z_][A-Za-z_0-9]*$/) defined[name] = 1
}

# The names that a line at the left margin of an anonymous namespace may define.
function define_names(line,   words, n, name) {
  if (match(line, /^using [A-Za-z_0-9:]+::[A-Za-z_0-9]+;/)) {
    # Another namespace's name.
    n = split(substr(line, RSTART, RLENGTH - 1), words, "::")
    define(words[n])
    return
  }
  if (match(line, /^(struct|class|union|enum( class)?|using) [A-Za-z_0-9]+/)) {
    n = split(substr(line, RSTART, RLENGTH), words, " ")
    define(words[n])
    return
  }
  gsub(/[A-Za-z_0-9]+::/, "", line)
  while (match(line, /[A-Za-z_0-9]+( =|[(\[{;])/)) {
    name = substr(line, RSTART, RLENGTH)
    sub(/[^A-Za-z_0-9].*/, "", name)
    define(name)
    # What follows the first parenthesis are parameters.
    if (substr(line, RSTART, RLENGTH) ~ /\($/) return
    line = substr(line, RSTART + RLENGTH)
  }
}

function close_file(   batch, name, fits) {
  if (file == "") return
  batch = 0
  if (!alone) {
    for (batch = 1; batch <= batches; ++batch) {
      if (size[batch] + lines > max_lines) continue
      fits = 1
      for (name in used)
        if ((batch, name) in taken) { fits = 0; break }
      if (fits) break
    }
    if (batch > batches) batches = batch
    size[batch] += lines
    for (name in defined) taken[batch, name] = 1
  }
  print batch, file
}

FNR == 1 { starts_file() }
{ ++lines }
/^#(define|undef)/ || /foreach_target/ || /^using namespace/ { alone = 1 }
/^[ \t]*\/\// || /^#/ { next }
/^namespace \{/ { anonymous = 1; next }
/^\} *\/\/ namespace$/ { anonymous = 0; next }
{
  gsub(/"([^"\\]|\\.)*"/, "")
  sub(/\/\/.*/, "")
  # Not what a macro makes, as TEST() does.
  if (anonymous && /^[A-Za-z]/ && !/^[A-Z_]+\(/) define_names($0)
  else if (/^static /) define_names($0)
  # Constants after the first of a declaration, and enumerators.
  if (anonymous && match($0, /^ +k[A-Z][A-Za-z_0-9]*( =|[\[{,;])/)) {
    name = $1
    sub(/[^A-Za-z_0-9].*/, "", name)
    define(name)
  }
  gsub(/(\.|->|::)[A-Za-z_][A-Za-z_0-9]*/, " ")
  gsub(/[^A-Za-z_0-9]+/, " ")
  words = split($0, word, " ")
  for (i = 1; i <= words; ++i) used[word[i]] = 1
}
END { close_file() }
