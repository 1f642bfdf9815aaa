// How many lobes a material may have. Nobody tells that beside the code that builds them: it runs,
// on inputs of all sorts, and what it would add is counted.
#pragma once

#include "base/hash.h"
#include "shading/materials.h"

namespace weft::shading {

/// The lobes that `LobeBuilder` would have added, and the inputs that it does so for.
class LobeCount {
  public:
    /// What connected inputs are: values inside of the upper halves of their ranges, the least, the
    /// greatest, or any of these.
    enum class Choice { inside, least, greatest, any };

    LobeCount(Choice choice, Rng& rng) : choice_(choice), rng_(rng) {}

    /// A lobe of the weight `w`, but for the weight of what it is a part of.
    void add(Color const& w) { lobes_ += !is_black(w); }
    /// A part, whatever its inputs: they are independent of those of the whole.
    void add_part(CompiledMaterial const& part, bool secondary) {
        lobes_ += part.most_lobes[secondary];
    }
    int lobes() const { return lobes_; }
    /// Whether any input was connected, so that other choices may count otherwise.
    bool has_choice() const { return has_choice_; }

    /// `material` whose connected inputs are literals.
    CompiledMaterial with_chosen_inputs(CompiledMaterial const& material);

  private:
    struct ChooseInputs;

    Choice choice_;
    Rng& rng_;
    int lobes_ = 0;
    bool has_choice_ = false;
};

/// The greatest number of lobes that the compiled material adds, wherever it is seen from. Inputs
/// that nodes feed may be anything in their ranges. The `most_lobes` of its parts must be known.
/// `part`: it is itself one of another material.
int most_lobes(Materials const& materials, scene::MaterialId id, bool part, bool secondary);

} // namespace weft::shading
