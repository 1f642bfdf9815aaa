// Typed indices into the vectors of a Scene. `category` is the tag that such an object has in a
// scene file.
#pragma once

#include "schema/values.h"

namespace weft::scene {

using schema::AnyValue;
using schema::FileName;
using schema::Input;
using schema::SurfaceNormal;
using schema::SurfacePosition;
using schema::SurfaceUv;
using schema::ValueType;

struct CameraKind {
    static constexpr char const* category = "camera";
};
struct MaterialKind {
    static constexpr char const* category = "bsdf";
};
struct LayerKind {
    static constexpr char const* category = "layer";
};
struct EmissionKind {
    static constexpr char const* category = "emission";
};
struct VolumeKind {
    static constexpr char const* category = "volume";
};
struct MediumKind {
    static constexpr char const* category = "medium";
};
struct ShapeKind {
    static constexpr char const* category = "shape";
};
struct InstanceKind {
    static constexpr char const* category = "instance";
};
struct LightKind {
    static constexpr char const* category = "light";
};
struct PortalKind {
    static constexpr char const* category = "portal";
};
struct SamplerKindTag {
    static constexpr char const* category = "sampler";
};
struct FilterKindTag {
    static constexpr char const* category = "filter";
};
struct SceneKind {
    static constexpr char const* category = "scene";
};
struct ImageKind {
    static constexpr char const* category = "image";
};
struct DisplayKind {
    static constexpr char const* category = "display";
};
struct IntegratorKind {
    static constexpr char const* category = "integrator";
};
struct PostprocessKind {
    static constexpr char const* category = "postprocess";
};

using TextureId = schema::Id<schema::TextureKind>;
using CameraId = schema::Id<CameraKind>;
using MaterialId = schema::Id<MaterialKind>;
using LayerId = schema::Id<LayerKind>;
using EmissionId = schema::Id<EmissionKind>;
using VolumeId = schema::Id<VolumeKind>;
using MediumId = schema::Id<MediumKind>;
using ShapeId = schema::Id<ShapeKind>;
using InstanceId = schema::Id<InstanceKind>;
using LightId = schema::Id<LightKind>;
using PortalId = schema::Id<PortalKind>;
using SamplerId = schema::Id<SamplerKindTag>;
using FilterId = schema::Id<FilterKindTag>;
using SceneId = schema::Id<SceneKind>;
using ImageId = schema::Id<ImageKind>;
using DisplayId = schema::Id<DisplayKind>;
using IntegratorId = schema::Id<IntegratorKind>;
using PostprocessId = schema::Id<PostprocessKind>;

} // namespace weft::scene
