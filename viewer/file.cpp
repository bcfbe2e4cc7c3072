// Whole files in and out.
#include "viewer/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "viewer/input_error.h"

namespace viewer {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& file, const char* what, int error) {
  throw InputError(file.string() + ": " + what + ": " + std::strerror(error));
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) fail(folder, "cannot make this folder", error.value());
}

fs::path besideFile(const fs::path& file) { return file.string() + ".part" + std::to_string(getpid()); }

template <class Bytes>
Bytes readAll(const fs::path& file) {
  errno = 0;
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) fail(file, "cannot read", EISDIR);
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "cannot read", errno);
  Bytes bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) fail(file, "cannot read", EIO);
  return bytes;
}

}  // namespace

std::vector<uint8_t> readFile(const fs::path& file) { return readAll<std::vector<uint8_t>>(file); }

std::string readText(const fs::path& file) { return readAll<std::string>(file); }

void writeFile(const fs::path& file, std::span<const uint8_t> bytes) {
  makeFolder(file.parent_path());
  const fs::path part = besideFile(file);
  errno = 0;
  std::ofstream out(part, std::ios::binary);
  if (!out) fail(file, "cannot write", errno);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  out.close();
  std::error_code error;
  if (!out) {
    const int cause = errno != 0 ? errno : EIO;
    fs::remove(part, error);
    fail(file, "cannot write", cause);
  }
  fs::rename(part, file, error);
  if (error) {
    const int cause = error.value();
    fs::remove(part, error);
    fail(file, "cannot write", cause);
  }
}

void writeText(const fs::path& file, std::string_view text) {
  writeFile(file, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

void requireWritableFolder(const fs::path& folder) {
  makeFolder(folder);
  const fs::path probe = besideFile(folder / "write-test");
  errno = 0;
  const bool writable = bool(std::ofstream(probe));
  if (!writable) fail(folder, "cannot write into this folder", errno);
  std::error_code ignored;
  fs::remove(probe, ignored);
}

fs::path programFolder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::current_path() : program.parent_path();
}

}  // namespace viewer
