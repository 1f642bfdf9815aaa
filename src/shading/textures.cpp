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

} // namespace weft::shading
