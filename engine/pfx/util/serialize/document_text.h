// The text of one document out of a file.
#pragma once

#include <cstdio>
#include <string>

#include "pfx/util/serialize/serialize_error.h"

namespace pfx::serial {

struct DocumentText {
  SerializeError error =
      SerializeError::Ok;  // File: it does not begin with "(tag"; Loading: it cannot be read
  std::string text;        // as far as there is any, to the parenthesis that closes the first
};

// Leaves the file behind the document, when the file can be positioned.
DocumentText readDocumentText(std::FILE* file, std::string_view tag);

}  // namespace pfx::serial
