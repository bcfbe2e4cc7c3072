# Plain comments become doxygen's: one in front of a declaration documents it, one behind a declaration that too.
/^ *\/\/( |$)/ {
  s/&/\&amp;/g
  s/</\&lt;/g
  s/>/\&gt;/g
  s/([@\\#$%])/\\\1/g
  s/^( *)\/\/( |$)/\1\/\/\/\2/
}
s/^([^"\/]*[;,{}][^"\/]*) \/\/ ([^<>@\\#$%&]*)$/\1 \/\/\/< \2/
