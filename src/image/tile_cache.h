// OpenImageIO's ImageCache as the textures of one process share it.
#pragma once

#include <OpenImageIO/imagecache.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

namespace weft::image {

class TileCache {
  public:
    TileCache();
    ~TileCache();
    TileCache(TileCache const&) = delete;
    TileCache& operator=(TileCache const&) = delete;

    OIIO::ImageCache& tiles() const { return *cache_; }
    /// The memory that tiles may take; the cache keeps to it but for the tiles just in use.
    void limit(uint64_t bytes);
    uint64_t bytes_read() const;

    /// Keeps the cache's message where it is the first.
    void note_failure(std::string const& path);
    std::string failure() const; ///< "" where there was none

  private:
    OIIO::ImageCache* cache_;
    mutable std::mutex mutex_; ///< of the failure alone
    std::string failure_;
};

} // namespace weft::image
