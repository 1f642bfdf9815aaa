// A text that never changes and that many things hold: the name of a file that a million places are
// in, the name of a set that a million instances belong to.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace weft {

/// Takes 8 bytes, and none besides where the text is empty. Copies share the text; they may be made
/// and dropped by several threads at once.
class SharedText {
  public:
    constexpr SharedText() = default;
    SharedText(std::string text) : block_(text.empty() ? nullptr : new Block{std::move(text)}) {}
    SharedText(std::string_view text) : SharedText(std::string(text)) {}
    SharedText(char const* text) : SharedText(std::string(text)) {}
    SharedText(SharedText const& o) : block_(o.block_) {
        if (block_) block_->uses.fetch_add(1, std::memory_order_relaxed);
    }
    SharedText(SharedText&& o) noexcept : block_(std::exchange(o.block_, nullptr)) {}
    SharedText& operator=(SharedText o) noexcept {
        std::swap(block_, o.block_);
        return *this;
    }
    constexpr ~SharedText() {
        if (block_ && block_->uses.fetch_sub(1, std::memory_order_acq_rel) == 1) delete block_;
    }

    std::string const& str() const {
        static std::string const none;
        return block_ ? block_->text : none;
    }
    operator std::string const&() const { return str(); }
    bool empty() const { return !block_; }
    friend bool operator==(SharedText const& a, SharedText const& b) {
        return a.block_ == b.block_ || a.str() == b.str();
    }

  private:
    struct Block {
        std::string text;
        std::atomic<uint32_t> uses{1};
    };
    Block* block_ = nullptr;
};

} // namespace weft
