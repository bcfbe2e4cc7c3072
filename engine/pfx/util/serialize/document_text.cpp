#include "pfx/util/serialize/document_text.h"

namespace pfx::serial {
namespace {

constexpr size_t kPieceBytes = 1 << 16;

bool beginsWith(std::string_view text, std::string_view tag) {
  const size_t begin = text.find_first_not_of(" \n\r\t");
  if (begin == std::string_view::npos || text[begin] != '(') return false;
  const std::string_view rest = text.substr(begin + 1);
  return rest.starts_with(tag) && rest.size() > tag.size() &&
         (rest[tag.size()] == ' ' || rest[tag.size()] == '\n');
}

}  // namespace

DocumentText readDocumentText(std::FILE* file, std::string_view tag) {
  DocumentText out;
  std::string& text = out.text;
  int depth = 0;
  while (true) {
    const size_t begin = text.size();
    text.resize(begin + kPieceBytes);
    const size_t got = std::fread(text.data() + begin, 1, kPieceBytes, file);
    text.resize(begin + got);
    if (begin == 0 && !beginsWith(text, tag)) out.error = SerializeError::File;
    if (std::ferror(file)) out.error = SerializeError::Loading;
    if (out.error != SerializeError::Ok || got == 0) return out;
    for (size_t i = begin; i < text.size(); ++i) {
      if (text[i] == '(') ++depth;
      if (text[i] != ')' || --depth > 0) continue;
      std::fseek(file, static_cast<long>(i + 1) - static_cast<long>(text.size()), SEEK_CUR);
      text.resize(i + 1);
      return out;
    }
  }
}

}  // namespace pfx::serial
