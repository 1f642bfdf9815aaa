// The file that an image came from, as a number: whether two machines, or two days, saw the same.
//
// All of the file counts, not its time or its place: parts of one picture are made by machines that
// have copies, and a texture that was painted over in one corner, and saved by the same program,
// keeps its size. OpenImageIO brings xxHash (Y. Collet), which is faster than files are read.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>

namespace weft::image {

class SourceFile {
  public:
    /// The path may name a layer (parts.h).
    explicit SourceFile(std::string path) : path_(std::move(path)) {}

    /// Of all bytes of the file as it is at the first call, which reads it; 0 where that cannot be
    /// done any more. Any thread may call it.
    uint64_t contents_hash() const;

  private:
    std::string path_;
    mutable std::once_flag once_;
    mutable uint64_t hash_ = 0;
};

} // namespace weft::image
