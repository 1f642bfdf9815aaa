#include "shading/textures.h"

namespace weft::shading {

void Textures::prepare(GraphCompiler& compiler, scene::TextureId id, SourceLocation const& where) {
    if (!id || roots_[size_t(id.index)].prepared) return;
    Root& r = roots_[size_t(id.index)];
    r.program = compiler.compile(id, where);
    r.prepared = true;
}

Vec3 Textures::at(scene::TextureId id, SurfacePoint const& point) const {
    return evaluate(root(id).program, point);
}

Vec2i Textures::resolution(scene::TextureId id) const {
    Root const& r = root(id);
    if (r.program.result.reg < 0) return {1, 1};
    Vec2i largest(0, 0);
    bool patterns = false;
    for (Instruction const& instruction : r.program.instructions) {
        if (auto const* image = std::get_if<ImageOp>(&instruction)) {
            largest.x = std::max(largest.x, image->lookup.image->width);
            largest.y = std::max(largest.y, image->lookup.image->height);
        } else {
            patterns = true;
        }
    }
    if (largest.x == 0) return {512, 256};
    return patterns ? Vec2i(std::max(largest.x, 512), std::max(largest.y, 256)) : largest;
}

} // namespace weft::shading
