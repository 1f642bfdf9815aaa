#include "image/tile_cache.h"

#include <algorithm>

namespace weft::image {

TileCache::TileCache() : cache_(OIIO::ImageCache::create(false)) {
    cache_->attribute("unassociatedalpha", 1); // as `read_image`
    // Texels stay in the type of the file, and files are as they are.
    cache_->attribute("forcefloat", 0);
    cache_->attribute("automip", 0);
    cache_->attribute("autotile", 0);
    cache_->attribute("accept_untiled", 0);
    cache_->attribute("trust_file_extensions", 0);
}

TileCache::~TileCache() { OIIO::ImageCache::destroy(cache_); }

void TileCache::limit(uint64_t bytes) {
    // OpenImageIO counts texels; open files and what holds the tiles came to an eighth more.
    double const texels = double(bytes) * 7 / 8;
    cache_->attribute("max_memory_MB", std::max(1.f, float(texels / (1 << 20))));
}

uint64_t TileCache::bytes_read() const {
    int64_t bytes = 0;
    cache_->getattribute("stat:bytes_read", OIIO::TypeDesc::INT64, &bytes);
    return uint64_t(bytes);
}

void TileCache::note_failure(std::string const& path) {
    std::string reason = cache_->geterror();
    std::lock_guard const lock(mutex_);
    if (failure_.empty())
        failure_ = path + ": cannot be read any more: " + reason.substr(0, reason.find('\n'));
}

std::string TileCache::failure() const {
    std::lock_guard const lock(mutex_);
    return failure_;
}

} // namespace weft::image
