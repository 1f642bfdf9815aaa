// What a path hands to the film: a value, the light it came from, and how it travelled. One call
// carries all of it, so that pictures by light or by component never need a second loop.
#pragma once

#include <cstdint>

#include "film/sample_record.h"

namespace weft::film {

/// Collects the contributions of one sample of one pixel: their sum and, where a record is given,
/// all that its layout asks for.
class SampleSink {
  public:
    SampleSink() = default;
    explicit SampleSink(SampleRecord* record) : record_(record) {}

    void add(Contribution const& c) {
        beauty_ += c.value;
        if (record_) [[unlikely]]
            record_->add(c);
    }
    Color const& beauty() const { return beauty_; }
    /// Null where beauty is all that is wanted.
    SampleRecord* record() const { return record_; }

    /// Tells that the path was in more objects at once than it can remember.
    void lose_track() { lost_track_ = true; }
    bool has_lost_track() const { return lost_track_; }

  private:
    Color beauty_;
    SampleRecord* record_ = nullptr;
    bool lost_track_ = false;
};

} // namespace weft::film
