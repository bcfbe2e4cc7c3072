#include "pfx/util/serialize/document.h"

#include <algorithm>

#include "pfx/util/serialize/document_text.h"

namespace pfx::serial {
namespace {

constexpr uint32_t kRecordsPerUpdate = 64;

struct SumText {
  char digits[16];
  explicit SumText(uint64_t sum) {
    for (int i = 15; i >= 0; --i, sum >>= 4) digits[i] = "0123456789abcdef"[sum & 15u];
  }
  std::string_view view() const { return {digits, sizeof digits}; }
};

// A failure before there is any text to point into.
struct PlainFailure {
  SerializeError error;
  const char* cause;
  const char* tags[2] = {};
  size_t num_tags = 0;
  SerializeFailure view() const {
    return {.error = error, .tags = {tags, num_tags}, .line = 0, .cause = cause};
  }
};

// Tells the application how it went.
SerializeError finish(const SerializeFailure& failure, std::span<RecordArray> arrays,
                      const DocumentCallbacks& calls) {
  if (failure.error != SerializeError::Ok) {
    if (calls.error) calls.error(failure);
    for (RecordArray& a : arrays) a.count = 0;
  }
  if (calls.term) calls.term(arrays);
  return failure.error;
}

// Data that should be there but are not.
const RecordArray* missingData(std::span<const RecordArray> arrays, uint32_t RecordArray::*size) {
  const auto it =
      std::ranges::find_if(arrays, [&](const RecordArray& a) { return a.*size > 0 && a.data == nullptr; });
  return it == arrays.end() ? nullptr : &*it;
}

SerializeError refuseToStart(PlainFailure failure, const DocumentCallbacks& calls) {
  if (calls.error) calls.error(failure.view());
  return failure.error;
}

void writeAll(TextWriter& out, const DocumentFormat& format, std::span<const RecordArray> arrays) {
  out.open(format.tag);
  out.number(format.version);
  out.newLine();
  out.open("counts");
  for (const RecordArray& a : arrays) out.open(a.tag), out.number(a.count), out.close();
  out.close();
  for (const RecordArray& a : arrays) {
    out.newLine();
    out.startCheckSum();
    out.open(a.tag);
    out.number(a.count);
    for (uint32_t i = 0; i < a.count && out.good(); ++i) {
      out.newLine();
      out.open(a.record_tag, i);
      a.write(out, arrays, a, i);
      if (out.good()) out.close();
    }
    if (!out.good()) return;
    const SumText sum(out.checkSum());
    out.newLine();
    out.open("check");
    out.word(sum.view());
    out.close();
    out.close();
  }
  out.close();
  out.newLine();
  out.flush();
}

// Each record is checked, then loaded.
class Progress {
 public:
  explicit Progress(const DocumentCallbacks& calls) : calls_(calls) {}
  void announce(std::span<const RecordArray> arrays) {
    max_ = 0;
    for (const RecordArray& a : arrays) max_ += 2 * a.count;
    max_ = std::max<uint32_t>(max_, 1);
  }
  void countRecord() {
    if (++done_ % kRecordsPerUpdate == 0 && done_ < max_ && calls_.update) calls_.update(done_, max_);
  }
  void end() {
    if (calls_.update) calls_.update(max_, max_);
  }

 private:
  const DocumentCallbacks& calls_;
  uint32_t done_ = 0, max_ = 0;
};

void readCounts(TextReader& in, std::span<RecordArray> arrays) {
  in.open("counts");
  for (RecordArray& a : arrays) {
    in.open(a.tag);
    in.number(a.count);
    in.close();
  }
  in.close();
}

void readArray(TextReader& in, std::span<const RecordArray> arrays, const RecordArray& a,
               Progress& progress) {
  in.startCheckSum();
  in.open(a.tag);
  uint32_t count = 0;
  in.number(count);
  if (in.good() && count != a.count)
    in.fail(SerializeError::Count, "the number differs from the one at the beginning");
  for (uint32_t i = 0; i < count && in.good(); ++i) {
    if (in.nextTag() == "check")
      return in.fail(SerializeError::Count, "there are fewer records than announced");
    in.open(a.record_tag, i);
    a.read(in, arrays, a, i);
    in.close();
    progress.countRecord();
  }
  if (in.nextTag() == a.record_tag) in.fail(SerializeError::Count, "there are more records than announced");
  const SumText sum(in.checkSum());
  in.open("check");
  const std::string_view written = in.word();
  in.require(written == sum.view(), "the check sum is wrong: something in this array was changed");
  in.close();
  in.close();
}

// Reads the counts and all records; keeps the records of arrays that have data.
void readAll(TextReader& in, const DocumentFormat& format, std::span<RecordArray> arrays,
             Progress& progress) {
  in.open(format.tag);
  uint32_t version = 0;
  in.number(version);
  if (in.good() && version != format.version)
    in.fail(SerializeError::Version, "the file is of another version");
  readCounts(in, arrays);
  progress.announce(arrays);
  for (const RecordArray& a : arrays) readArray(in, arrays, a, progress);
  in.close();
}

}  // namespace

SerializeError writeDocument(std::FILE* file, const DocumentFormat& format, std::span<RecordArray> arrays,
                             const DocumentCallbacks& calls) {
  if (file == nullptr) return refuseToStart({SerializeError::File, "there is no file"}, calls);
  if (!calls.init) return refuseToStart({SerializeError::Data, "there is no init function"}, calls);
  calls.init(arrays);
  if (const RecordArray* a = missingData(arrays, &RecordArray::count))
    return finish(PlainFailure{SerializeError::Data, "there is no array", {format.tag, a->tag}, 2}.view(),
                  arrays, calls);
  TextWriter check(nullptr);
  writeAll(check, format, arrays);
  if (!check.good()) return finish(check.failure(), arrays, calls);
  TextWriter out(file);
  writeAll(out, format, arrays);
  const bool flushed = !out.good() || std::fflush(file) == 0;
  if (!flushed)
    return finish(PlainFailure{SerializeError::Saving, "the file cannot be written"}.view(), arrays, calls);
  return finish(out.failure(), arrays, calls);
}

SerializeError readDocument(std::FILE* file, const DocumentFormat& format, std::span<RecordArray> arrays,
                            const DocumentCallbacks& calls) {
  if (file == nullptr) return refuseToStart({SerializeError::File, "there is no file"}, calls);
  if (!calls.init) return refuseToStart({SerializeError::Data, "there is no init function"}, calls);
  calls.init(arrays);
  if (const RecordArray* a = missingData(arrays, &RecordArray::capacity))
    return finish(PlainFailure{SerializeError::Data, "there is no array", {format.tag, a->tag}, 2}.view(),
                  arrays, calls);
  const DocumentText document = readDocumentText(file, format.tag);
  if (document.error != SerializeError::Ok)
    return finish(PlainFailure{document.error, toString(document.error)}.view(), arrays, calls);

  std::vector<RecordArray> checked(arrays.begin(), arrays.end());
  for (RecordArray& a : checked) a.data = nullptr;
  Progress progress(calls);
  TextReader check(document.text);
  readAll(check, format, checked, progress);
  if (!check.good()) return finish(check.failure(), arrays, calls);
  for (size_t i = 0; i < arrays.size(); ++i) arrays[i].count = checked[i].count;

  const auto short_of = [](const RecordArray& a) {
    return a.count > a.capacity || (a.count > 0 && a.data == nullptr);
  };
  if (std::ranges::any_of(arrays, short_of) && calls.resize && calls.resize(arrays))
    for (size_t i = 0; i < arrays.size(); ++i) arrays[i].count = checked[i].count;
  if (const auto a = std::ranges::find_if(arrays, short_of); a != arrays.end()) {
    return finish(
        PlainFailure{
            SerializeError::Loading, "the buffers are too small for the file", {format.tag, a->tag}, 2}
            .view(),
        arrays, calls);
  }
  TextReader in(document.text);
  readAll(in, format, arrays, progress);
  if (in.good()) progress.end();
  return finish(in.failure(), arrays, calls);
}

}  // namespace pfx::serial
