// Whole files in and out, with errors that name the file and the cause.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viewer {

// The bytes or the text of a file. Throw InputError.
std::vector<uint8_t> readFile(const std::filesystem::path& file);
std::string readText(const std::filesystem::path& file);

// Makes missing folders, writes beside the file and moves it into place, so that a reader never sees half of
// it. Throw InputError.
void writeFile(const std::filesystem::path& file, std::span<const uint8_t> bytes);
void writeText(const std::filesystem::path& file, std::string_view text);

// Makes the folder when it is missing and tests that a file can be made in it; for checking --out before long
// work. Throws InputError.
void requireWritableFolder(const std::filesystem::path& folder);

// The folder of the running program.
std::filesystem::path programFolder();

}  // namespace viewer
