#include "pfx/base_level/error.h"

namespace pfx {

const char* toString(Error error) {
  switch (error) {
    case Error::Ok: return "ok";
    case Error::NullPointer: return "a required pointer is null";
    case Error::OutOfRange: return "a value is out of range";
    case Error::InvalidValue: return "a value is not finite or not allowed";
    case Error::InvalidAlignment: return "a buffer is misaligned";
    case Error::OutOfBuffer: return "a work buffer is too short";
    case Error::OutOfMaxPairs: return "the pair buffer is full";
    case Error::OutOfMaxContacts: return "the contact pool is full";
    case Error::OutOfWorld: return "a body lies outside the world";
    case Error::NotConvex: return "the input is not convex";
    case Error::Degenerate: return "the input is degenerate";
  }
  return "unknown error";
}

}  // namespace pfx
