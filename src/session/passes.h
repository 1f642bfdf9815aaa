// The passes of one render: which samples are made next is decided between them, by the film and
// the limits alone.
#pragma once

#include "session/gate.h"
#include "session/progress_meter.h"
#include "session/render.h"

namespace weft::session {

class Passes {
  public:
    /// What follows a pass that is whole. Interrupted: `cancel` was set before it was known.
    enum class Next { Pass, End, Interrupted };

    /// All of them outlive the object. Sets the first pass where `result` does not go on from one.
    Passes(Plan const& plan, RenderOptions const& options, RenderResult& result, Gate& gate,
           ProgressMeter& meter);

    /// Decides what follows the pass at hand, which is whole: sets the next pass, or says why the
    /// render ends. Where it is interrupted, the pass stays what it was.
    Next next();

  private:
    uint32_t end_of_pass(uint32_t from) const;
    bool decide(std::vector<float> const& errors, PassState& next);
    bool fits(uint32_t done, PassState& next) const;
    Next end(StoppedBy why);

    Limits const& limits_;
    Part const& part_;
    RenderResult& result_;
    Gate& gate_;
    ProgressMeter& meter_;
    uint32_t first_, last_; ///< of the samples that a pixel gets: the first, and past the last
};

} // namespace weft::session
