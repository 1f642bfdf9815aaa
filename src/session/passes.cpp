#include "session/passes.h"

#include <algorithm>
#include <cmath>

#include "session/adaptive.h"

namespace weft::session {

namespace {

/// Returns the end of the pass that starts at sample `from`: 1, 2, 4, ... so that a first picture
/// is there soon, and then as many samples as keep passes long enough not to matter.
uint32_t even_pass_end(uint32_t from, uint32_t limit) {
    constexpr uint32_t longest = 64;
    return std::min(limit, from + std::clamp(from, 1u, longest));
}

} // namespace

Passes::Passes(Plan const& plan, RenderOptions const& options, RenderResult& result, Gate& gate,
               ProgressMeter& meter)
    : limits_(options.limits), part_(options.picture.part), result_(result), gate_(gate),
      meter_(meter), first_(part_.first), last_(part_.last > 0 ? part_.last : plan.samples) {
    if (result.pass.to == 0) result.pass.to = end_of_pass(first_);
}

Passes::Next Passes::next() {
    PassState next;
    uint32_t const done = result_.pass.to;
    if (limits_.noise > 0 && done >= std::min(kLeastSamples, last_)) {
        auto const errors = block_errors(result_.film, [&] { return is_cancelled(limits_); });
        if (errors.empty()) return Next::Interrupted;
        if (!decide(errors, next)) return end(StoppedBy::noise);
    }
    if (done >= last_) return end(StoppedBy::samples);
    if (is_cancelled(limits_)) return Next::Interrupted;
    next.to = end_of_pass(done);
    if (limits_.seconds > 0 && !fits(done, next)) return end(StoppedBy::time);
    auto const standing_still = gate_.stop();
    result_.pass = std::move(next);
    return Next::Pass;
}

uint32_t Passes::end_of_pass(uint32_t from) const {
    return limits_.noise > 0 ? adaptive_pass_end(from, last_)
                             : first_ + even_pass_end(from - first_, last_ - first_);
}

Passes::Next Passes::end(StoppedBy why) {
    result_.stopped_by = why;
    return Next::End;
}

/// Chooses the blocks of the next pass. Returns false where the noise is reached everywhere.
bool Passes::decide(std::vector<float> const& errors, PassState& next) {
    double const noise = double(*std::max_element(errors.begin(), errors.end()));
    result_.noise = noise;
    meter_.reached(noise);
    meter_.expect(meter_.done() + samples_needed(result_.film, errors, limits_.noise, last_));
    next.active = active_blocks(result_.film, errors, limits_.noise, last_);
    return noise > limits_.noise;
}

/// Shortens the next pass to what the time left is likely to hold. Returns false where that is
/// nothing.
bool Passes::fits(uint32_t done, PassState& next) const {
    double const left = limits_.seconds - meter_.seconds();
    film::Region const& region = result_.film.region();
    double pixels = double(region.pixels()) / part_.shards;
    if (!next.active.empty()) {
        BlockGrid const grid(region);
        pixels = 0;
        for (size_t i = 0; i < next.active.size(); ++i)
            if (next.active[i]) pixels += double(grid.block(i).pixels());
    }
    double const samples = std::floor(left * meter_.rate() / pixels);
    if (!(samples >= 1)) return false;
    next.to = uint32_t(std::min(double(next.to), double(done) + samples));
    return true;
}

} // namespace weft::session
