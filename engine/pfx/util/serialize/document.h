// A file of arrays of records, and the callbacks through which an application gives its memory.
//
// What the records are does not matter here: a RecordArray says how one is written and read.
// scene_serializer.h has those of the engine. The file is text:
//   (TAG VERSION
//   (counts (ARRAY n) ...)
//   (ARRAY n (RECORD ...) ... (check SUM)) ...)
// A file is checked to its end before anything of it is handed over, so that a damaged one changes nothing.
#pragma once

#include <cstdio>
#include <functional>

#include "pfx/util/serialize/text_reader.h"
#include "pfx/util/serialize/text_writer.h"

namespace pfx::serial {

struct RecordArray {
  using Arrays = std::span<const RecordArray>;  // all of the file, for records that point at others
  const char* tag;                              // as "states"
  const char* record_tag;                       // as "state"
  void (*write)(TextWriter&, Arrays, const RecordArray&, uint32_t index);
  // Without data the record is read and forgotten.
  void (*read)(TextReader&, Arrays, const RecordArray&, uint32_t index);
  uint32_t count = 0;     // of records: to write, or in the file
  uint32_t capacity = 0;  // reading: records that there is room for
  void* data = nullptr;
};

// An array of T with two functions fn(archive, arrays, record); reading also checks the record.
template <class T, auto Write, auto Read>
RecordArray recordArray(const char* tag, const char* record_tag) {
  return {.tag = tag,
          .record_tag = record_tag,
          .write = [](TextWriter& out, RecordArray::Arrays all, const RecordArray& a,
                      uint32_t i) { Write(out, all, static_cast<T*>(a.data)[i]); },
          .read =
              [](TextReader& in, RecordArray::Arrays all, const RecordArray& a, uint32_t i) {
                T read{};
                Read(in, all, read);
                if (a.data != nullptr && in.good()) static_cast<T*>(a.data)[i] = std::move(read);
              }};
}

struct DocumentFormat {
  const char* tag;  // of the outermost group
  uint32_t version;
};

struct DocumentCallbacks {
  // First: gives data and counts (writing), or data and capacities (reading). Required.
  std::function<void(std::span<RecordArray>)> init;
  // Last, whenever init was called: counts are the records that were written or loaded, all zero after a
  // failure.
  std::function<void(std::span<const RecordArray>)> term;
  // Reading, when a count exceeds its capacity: gives other data and capacities; false when it cannot.
  std::function<bool(std::span<RecordArray>)> resize;
  // Reading, now and then: never falls, and ends with progress == max.
  std::function<void(uint32_t progress, uint32_t max)> update;
  std::function<void(const SerializeFailure&)> error;
};

// The file must be open and stays so; writing goes on, and reading ends, where the document ends. `arrays`
// are those of the format, in order.
SerializeError writeDocument(std::FILE* file, const DocumentFormat& format, std::span<RecordArray> arrays,
                             const DocumentCallbacks& callbacks);
SerializeError readDocument(std::FILE* file, const DocumentFormat& format, std::span<RecordArray> arrays,
                            const DocumentCallbacks& callbacks);

}  // namespace pfx::serial
