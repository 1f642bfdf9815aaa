#include "io/scene_file.h"

#include <algorithm>
#include <array>

#include "io/object_reader_impl.h"

namespace weft::io {

namespace {

/// The elements below `from` (itself excluded) with this id or, failing that, this tag.
std::vector<XmlElement*> find_elements(XmlElement& from, std::string_view name) {
    std::vector<XmlElement*> all, by_id, by_tag;
    for (auto const& child : from.children) all.push_back(child.get());
    for (size_t i = 0; i < all.size(); ++i) {
        if (all[i]->tag == "ref" || is_property_tag(all[i]->tag)) continue;
        if (all[i]->get("id") == name) by_id.push_back(all[i]);
        if (all[i]->tag == name) by_tag.push_back(all[i]);
        for (auto const& child : all[i]->children) all.push_back(child.get());
    }
    return by_id.empty() ? by_tag : by_id;
}

void set_parameter(XmlElement& element, std::string const& name, std::string const& value, SourceLocation const& where) {
    std::erase_if(element.children, [&](auto const& child) {
        return child->get("name") == name || (child->tag == name && !child->find("name"));
    });
    for (XmlAttribute& a : element.attributes) {
        if (a.name != name) continue;
        a.value = value;
        a.where = where;
        return;
    }
    element.attributes.push_back({name, value, where});
}

void apply_override(XmlElement& root, std::string const& override_text) {
    SourceLocation const where{"--set " + override_text, 0, 0};
    size_t const equals = override_text.find('=');
    size_t const dot = override_text.rfind('.', equals);
    if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == equals)
        throw InputError(where, "expected PATH.PARAM=VALUE, for example camera.fov=30");
    std::vector<XmlElement*> found{&root};
    for (size_t from = 0; from <= dot;) {
        size_t const to = std::min(override_text.find('.', from), dot);
        std::string const name = override_text.substr(from, to - from);
        std::vector<XmlElement*> next;
        for (XmlElement* e : found)
            for (XmlElement* inner : find_elements(*e, name)) next.push_back(inner);
        if (next.empty()) throw InputError(where, "the scene has no object with the id or tag '" + name + "'");
        found = std::move(next);
        from = to + 1;
    }
    for (XmlElement* e : found)
        set_parameter(*e, override_text.substr(dot + 1, equals - dot - 1), override_text.substr(equals + 1), where);
}

class JobReader {
  public:
    explicit JobReader(Document& document) : document_(document) {}

    RenderJob read_integrator(XmlElement const& element) {
        RenderJob job;
        job.where = element.where;
        job.folder = element.folder;
        scene::Scene unused;
        SceneBuilder builder(document_, unused);
        job.integrator = builder.read_variant<scene::Integrator>(element);
        job.target = match(job.integrator, [](auto const& i) { return i.target; });
        job.sampler = builder.sampler;
        job.scene = read_scene(*builder.scene_element);
        if (builder.image_element) job.image_name = builder.image_element->get("id");
        return job;
    }

    RenderJob read_test(XmlElement const& element) {
        XmlAttribute const* type = element.find("type");
        if (!type || type->value != "image")
            throw InputError(type ? type->where : element.where, "<test> expects type=\"image\"" + (type ? ", found '" + type->value + "'" : std::string()));
        if (element.get("id").empty()) throw InputError(element.where, "<test> expects an id: it names the reference ID_ref.exr");
        XmlElement const* integrator = nullptr;
        XmlElement parameters{element.tag, element.attributes, {}, element.where, element.folder};
        for (auto const& child : element.children) {
            if (is_property_tag(child->tag)) {
                parameters.attributes.push_back({std::string(child->get("name")), property_value(*child).value, child->where});
            } else if (child->tag == "integrator" && !integrator) {
                integrator = child.get();
            } else if (!child->find("id") || child->tag == "integrator") {
                throw InputError(child->where, "<test> expects one <integrator>, found " + element_title(*child));
            }
        }
        if (!integrator) throw InputError(element.where, "<test> expects an <integrator>, found none");
        scene::Scene unused;
        RenderJob job = read_integrator(*integrator);
        job.test = SceneBuilder(document_, unused).read_struct<scene::ImageTest>(parameters);
        job.image_name = element.get("id");
        return job;
    }

    std::shared_ptr<scene::Scene const> read_scene(XmlElement const& element) {
        auto& scene = scenes_[&element];
        if (!scene) {
            auto fresh = std::make_shared<scene::Scene>();
            fresh->contents = SceneBuilder(document_, *fresh).read_struct<scene::SceneContents>(element);
            scene = std::move(fresh);
        }
        return scene;
    }

  private:
    Document& document_;
    std::map<XmlElement const*, std::shared_ptr<scene::Scene const>> scenes_;
};

SceneFile read_document(std::unique_ptr<XmlElement> root, std::vector<std::string> const& overrides) {
    static std::vector<std::string> const known{"integrator", "test", "scene", "postprocess", "include", "bsdf", "texture", "shape", "instance", "light", "camera", "emission", "volume", "medium", "sampler", "image", "transform"};
    for (std::string const& o : overrides) apply_override(*root, o);
    Document document{std::move(root), {}, {}, {}};
    index_ids(document);
    JobReader reader(document);
    SceneFile file;
    XmlElement const* lone_scene = nullptr;
    for (auto const& child : document.root->children) {
        if (child->tag == "integrator") {
            file.jobs.push_back(reader.read_integrator(*child));
        } else if (child->tag == "test") {
            file.jobs.push_back(reader.read_test(*child));
        } else if (child->tag == "scene") {
            lone_scene = child.get();
        } else if (child->tag == "postprocess") {
            file.warnings.push_back(to_string(child->where) + ": " + element_title(*child) + " is not supported yet and is left out");
        } else if (std::find(known.begin(), known.end(), child->tag) == known.end()) {
            throw InputError(child->where, "unknown tag <" + child->tag + ">" + suggestion(child->tag, known));
        }
    }
    if (file.jobs.empty() && lone_scene) {
        RenderJob job{scene::PathIntegrator{}, {}, {}, reader.read_scene(*lone_scene), std::string(lone_scene->get("id")), lone_scene->folder, {}, lone_scene->where};
        file.jobs.push_back(std::move(job));
    }
    if (file.jobs.empty()) throw InputError(document.root->where, "expected an <integrator>, <test> or <scene>, found none");
    return file;
}

template <class Variant>
void add_schemas(std::vector<schema::Schema>& to) {
    for_each_type<Variant>([&]<class T>() { to.push_back(schema::schema_of<T>()); });
}

} // namespace

SceneFile read_scene_file(std::string const& path, std::vector<std::string> const& overrides) {
    return read_document(read_xml(path), overrides);
}

SceneFile parse_scene(std::string const& text, std::string const& name, std::string const& folder,
                      std::vector<std::string> const& overrides) {
    return read_document(parse_xml(text, name, folder), overrides);
}

std::vector<schema::Schema> all_schemas() {
    std::vector<schema::Schema> all;
    all.push_back(schema::schema_of<scene::SceneContents>());
    add_schemas<scene::Camera>(all);
    all.push_back(schema::schema_of<scene::Instance>());
    add_schemas<scene::Shape>(all);
    add_schemas<scene::Material>(all);
    all.push_back(schema::schema_of<scene::LambertianEmission>());
    add_schemas<scene::Texture>(all);
    add_schemas<scene::Light>(all);
    all.push_back(schema::schema_of<scene::HomogeneousMedium>());
    all.push_back(schema::schema_of<scene::ConstantVolume>());
    add_schemas<scene::Sampler>(all);
    add_schemas<scene::Integrator>(all);
    all.push_back(schema::schema_of<scene::ImageOutput>());
    all.push_back(schema::schema_of<scene::ImageTest>());
    return all;
}

} // namespace weft::io
