#include "pfx/util/serialize/serialize_error.h"

namespace pfx {

const char* toString(SerializeError error) {
  switch (error) {
    case SerializeError::Ok:
      return "ok";
    case SerializeError::Loading:
      return "loading failed";
    case SerializeError::Saving:
      return "saving failed";
    case SerializeError::Data:
      return "a value is not allowed";
    case SerializeError::Parenthesis:
      return "a parenthesis is missing or one too many";
    case SerializeError::File:
      return "not a file of this kind";
    case SerializeError::Version:
      return "the version is another one";
    case SerializeError::Tag:
      return "a tag is unknown here";
    case SerializeError::Form:
      return "a number is not written as one";
    case SerializeError::Count:
      return "the number of records is wrong";
  }
  return "unknown error";
}

std::string describe(const SerializeFailure& failure) {
  std::string text;
  if (failure.line > 0) text += "line " + std::to_string(failure.line) + ": ";
  for (size_t i = 0; i < failure.tags.size(); ++i) (text += i == 0 ? "" : " > ") += failure.tags[i];
  if (!failure.tags.empty()) text += ": ";
  text += failure.cause.empty() ? toString(failure.error) : failure.cause;
  return text;
}

}  // namespace pfx
