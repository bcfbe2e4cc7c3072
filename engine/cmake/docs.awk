# Plain comments become doxygen's. The first one of a file documents the file; one behind a declaration documents that; one in
# front of declarations documents all of them up to the next comment or empty line, as they are meant to be read.

function escaped(text) {
  gsub(/&/, "\\&amp;", text); gsub(/</, "\\&lt;", text); gsub(/>/, "\\&gt;", text)
  gsub(/[@\\#$%]/, "\\\\&", text)
  return text
}
function isComment(line) { return line ~ /^ *\/\/( |$)/ }
function indentOf(line) { match(line, /^ */); return RLENGTH }
function documented(line) {
  match(line, /^ *\/\//)
  return substr(line, 1, RLENGTH) "/" escaped(substr(line, RLENGTH + 1))
}
# The comment behind a declaration.
function trailing(line,   at) {
  at = index(line, "//")
  if (at == 0 || at < 3 || line ~ /^ *# *(include|if|el|end|pragma)/ || substr(line, 1, at - 1) ~ /["\/]/ || substr(line, at + 2, 1) == "/") return line
  if (substr(line, 1, at - 1) !~ /[;,{}()A-Za-z0-9_] +$/) return line
  return substr(line, 1, at - 1) "///<" escaped(substr(line, at + 2))
}
# What opens a scope of declarations, and not a body or a list of values.
function declares(text) {
  gsub(/template *<[^>]*>/, "", text); gsub(/alignas\([^)]*\)/, "", text)
  return text ~ /(^|[ \t])(struct|class|enum|union|namespace)([ \t{:]|$)/ && text !~ /[(=]/
}
function follow(line,   k, c) {  # keeps the stack of scopes
  sub(/\/\/.*/, "", line); gsub(/"[^"]*"/, "", line); gsub(/'[^']*'/, "", line)
  if (line ~ /^ *#/ || in_macro) { in_macro = line ~ /\\$/; return }
  for (k = 1; k <= length(line); ++k) {
    c = substr(line, k, 1)
    if (c == "{") { scope[++depth] = declares(statement) ? (statement ~ /(^|[ \t])enum([ \t]|$)/ ? "enum" : "type") : "body"; statement = "" }
    else if (c == "}") { if (depth > 0) --depth; statement = "" }
    else if (c == ";") statement = ""
    else statement = statement c
  }
  statement = statement " "
}
function inBody(   k) {
  for (k = 1; k <= depth; ++k) if (scope[k] == "body") return 1
  return 0
}
# The last line of the run of declarations that begins at `first`, 0 when there is but one.
function runEnd(first,   k, n, indent) {
  indent = indentOf(lines[first])
  n = 0
  for (k = first; k <= count; ++k) {
    if (lines[k] ~ /^ *$/ || isComment(lines[k])) break
    if (indentOf(lines[k]) < indent || lines[k] ~ /^ *(public|private|protected):/ || lines[k] ~ /^ *#(if|el|end|incl|prag|undef)/) break
    if (indentOf(lines[k]) == indent && lines[k] ~ /^ *(template *<.*>|private|public)$/) continue
    if (indentOf(lines[k]) == indent && lines[k] ~ /^ *(struct|class|enum|union|namespace|friend|static_assert)[ \t]/) break
    if (indentOf(lines[k]) == indent && lines[k] !~ /^ *[})]/) ++n
  }
  return n > 1 ? k - 1 : 0
}

{ lines[++count] = $0 }
END {
  for (i = 1; i <= count; ++i) {
    if (!isComment(lines[i]) || inBody()) {
      print inBody() ? lines[i] : trailing(lines[i])
      follow(lines[i])
      if (i == close_at) { print "///@}"; close_at = 0 }
      continue
    }
    for (j = i; j < count && isComment(lines[j + 1]); ++j) {}
    if (i == 1) print "/// \\file"
    attached = i == 1 || (j < count && lines[j + 1] !~ /^ *($|})/)
    close_at = i > 1 && attached && scope[depth] != "enum" ? runEnd(j + 1) : 0
    if (close_at) print "///@{"
    for (; i <= j; ++i) print attached ? documented(lines[i]) : lines[i]
    --i
  }
}
