// Files of tests/io/bad that a reader must refuse, each with the message in NAME.EXT.expected.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.h"

namespace weft::testing {

inline std::string read_bytes(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Calls read(bytes, file name) for every bad file with `extension`, expects its message, and
/// returns how many there are.
template <class Read>
int expect_refusals(std::string const& extension, Read const& read) {
    int count = 0;
    for (auto const& entry :
         std::filesystem::directory_iterator(std::string(WEFT_SOURCE_DIR) + "/tests/io/bad")) {
        if (entry.path().extension() != extension) continue;
        ++count;
        std::string expected = read_bytes(entry.path().string() + ".expected");
        while (!expected.empty() && expected.back() == '\n') expected.pop_back();
        std::string const name = entry.path().filename().string();
        std::string found = "no error";
        try {
            read(read_bytes(entry.path()), name);
        } catch (InputError const& e) {
            found = e.what();
        }
        EXPECT_EQ(found, expected) << name;
    }
    return count;
}

} // namespace weft::testing
