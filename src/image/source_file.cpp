#include "image/source_file.h"

#include <OpenImageIO/hash.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "image/parts.h"

namespace weft::image {

namespace {

uint64_t hash_file(std::string const& path) {
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> const file(std::fopen(path.c_str(), "rb"),
                                                               &std::fclose);
    if (!file) return 0;
    std::vector<char> block(1 << 20);
    uint64_t hash = 0, size = 0;
    while (size_t const n = std::fread(block.data(), 1, block.size(), file.get())) {
        hash = OIIO::xxhash::xxhash(block.data(), n, hash);
        size += n;
    }
    return std::ferror(file.get()) ? 0 : hash ^ size;
}

} // namespace

uint64_t SourceFile::contents_hash() const {
    std::call_once(once_, [&] {
        LayerPath const wanted = split_layer(path_);
        hash_ = hash_file(wanted.file);
        if (hash_ != 0 && !wanted.layer.empty())
            hash_ = OIIO::xxhash::xxhash(wanted.layer.data(), wanted.layer.size(), hash_);
    });
    return hash_;
}

} // namespace weft::image
