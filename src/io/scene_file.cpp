#include "io/scene_file.h"

#include <algorithm>
#include <array>

#include "io/gltf.h"
#include "io/modernise.h"
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

void set_parameter(XmlElement& element, std::string const& name, std::string const& value,
                   SourceLocation const& where) {
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

/// The elements that the first name of a path, or the next below `from`, leads to.
std::vector<XmlElement*> follow(std::vector<XmlElement*> const& from, std::string const& name,
                                SourceLocation const& where) {
    std::vector<XmlElement*> found;
    for (XmlElement* e : from)
        for (XmlElement* inner : find_elements(*e, name))
            if (std::find(found.begin(), found.end(), inner) == found.end()) found.push_back(inner);
    if (!found.empty()) return found;
    std::vector<std::string> known;
    auto collect = [&](auto const& self, XmlElement const& e) -> void {
        for (auto const& child : e.children) {
            if (child->tag == "ref" || is_property_tag(child->tag)) continue;
            for (std::string_view n : {child->get("id"), std::string_view(child->tag)})
                if (!n.empty() && std::find(known.begin(), known.end(), n) == known.end())
                    known.emplace_back(n);
            self(self, *child);
        }
    };
    for (XmlElement* e : from) collect(collect, *e);
    throw InputError(where,
                     "no object has the id or tag " + in_quotes(name) + suggestion(name, known));
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
        found = follow(found, override_text.substr(from, to - from), where);
        from = to + 1;
    }
    std::string const name = override_text.substr(dot + 1, equals - dot - 1);
    for (XmlElement* e : found) set_parameter(*e, name, override_text.substr(equals + 1), where);
}

class JobReader {
  public:
    explicit JobReader(Document& document) : document_(document) {}

    scene::RenderJob read_integrator(XmlElement const& element) {
        scene::RenderJob job;
        job.where = element.where;
        job.folder = element.folder;
        scene::Scene unused;
        SceneBuilder builder(document_, unused);
        job.integrator = builder.read_variant<scene::Integrator>(element);
        job.target = match(job.integrator, [](auto const& i) { return i.target; });
        job.sampler = builder.sampler;
        job.scene = read_scene(*builder.scene_element);
        if (auto const image = job.target.image) {
            expect_output(image.index);
            job.image_name = picture_name(*document_.pictures[size_t(image.index)]);
            made_.insert(image.index);
        }
        return job;
    }

    scene::PostprocessJob read_postprocess(XmlElement const& element, size_t jobs_before) {
        scene::Scene unused;
        SceneBuilder builder(document_, unused);
        scene::PostprocessJob job{builder.read_variant<scene::Postprocess>(element), jobs_before,
                                  element.where};
        auto const pictures = scene::pictures_of(job.postprocess);
        for (auto const& [name, id] : pictures.inputs) {
            if (made_.contains(id.index) || document_.files.contains(id.index)) continue;
            XmlElement const& image = *document_.pictures[size_t(id.index)];
            throw InputError(location_of(element, name),
                             in_quotes(name) + " of " + element_title(element) +
                                 " expects the image of an integrator or postprocess that comes "
                                 "before it, found " +
                                 in_quotes(image.get("id")) + ", which none of them makes");
        }
        XmlElement const& image = *document_.pictures[size_t(pictures.output.index)];
        expect_output(pictures.output.index);
        if (picture_name(image).empty())
            throw InputError(image.where, "<image> of " + element_title(element) +
                                              " expects an id: it names the file ID.exr");
        made_.insert(pictures.output.index);
        return job;
    }

    /// Reads a test into the jobs or the postprocesses of the file.
    void read_test(XmlElement const& element, SceneFile& file) {
        scene::Scene unused;
        SceneBuilder builder(document_, unused);
        auto const test = std::get<scene::ImageTest>(
            builder.read_variant<std::variant<scene::ImageTest>>(element));
        if (element.get("id").empty())
            throw InputError(element.where,
                             "<test> expects an id: it names the reference ID_ref.exr");
        if (bool(builder.integrator_element) == bool(builder.postprocess_element))
            throw InputError(element.where, element_title(element) +
                                                " expects either an <integrator> or a "
                                                "<postprocess>, found " +
                                                (builder.integrator_element ? "both" : "none"));
        if (builder.integrator_element) {
            scene::RenderJob job = read_integrator(*builder.integrator_element);
            job.test = test;
            job.image_name = picture_name(element);
            file.jobs.push_back(std::move(job));
        } else {
            scene::PostprocessJob job =
                read_postprocess(*builder.postprocess_element, file.jobs.size());
            job.test = test;
            job.test_name = picture_name(element);
            file.postprocesses.push_back(std::move(job));
        }
    }

    /// A picture that is made must not be one that is there already.
    void expect_output(int32_t picture) const {
        if (!document_.files.contains(picture)) return;
        XmlElement const& image = *document_.pictures[size_t(picture)];
        throw InputError(location_of(image, "filename"),
                         "'filename' is for pictures that a postprocess reads; a picture that is "
                         "made is written as ID.exr");
    }

    /// The element's id, which becomes a file beside the scene and must not lead elsewhere.
    static std::string picture_name(XmlElement const& element) {
        std::string id(element.get("id"));
        if (id.find('/') != std::string::npos || id.find("..") != std::string::npos)
            throw InputError(element.where,
                             "expected an id that can name a file, without '/' and '..', found '" +
                                 id + "'");
        return id;
    }

    std::shared_ptr<scene::Scene const> read_scene(XmlElement const& element) {
        auto& scene = scenes_[&element];
        if (!scene) {
            auto fresh = std::make_shared<scene::Scene>();
            fresh->contents =
                SceneBuilder(document_, *fresh).read_struct<scene::SceneContents>(element);
            scene = std::move(fresh);
        }
        return scene;
    }

    /// A file without an integrator: `path` with its defaults.
    scene::RenderJob default_job(XmlElement const& scene) {
        scene::RenderJob job;
        job.integrator = scene::PathIntegrator{};
        job.scene = read_scene(scene);
        job.image_name = picture_name(scene);
        job.folder = scene.folder;
        job.where = scene.where;
        return job;
    }

    /// A scene that no integrator refers to is read for its mistakes alone.
    void check_scene(XmlElement const& element) {
        if (scenes_.contains(&element)) return;
        scene::Scene unused;
        SceneBuilder(document_, unused, Files::find).read_struct<scene::SceneContents>(element);
    }

  private:
    Document& document_;
    std::map<XmlElement const*, std::shared_ptr<scene::Scene const>> scenes_;
    std::set<int32_t> made_; ///< pictures that the file's integrators and postprocesses make
};

std::vector<std::string> root_tags() {
    std::vector<std::string> tags{"integrator", "test", "scene", "postprocess"};
    auto const more = definition_tags();
    tags.insert(tags.end(), more.begin(), more.end());
    return tags;
}

/// Mistakes in what nothing refers to are mistakes, too.
void check_unused(Document& document, XmlElement const& element) {
    for (auto const& child : element.children) {
        if (is_definition_tag(child->tag) && !document.used.contains(child.get())) {
            scene::Scene unused;
            SceneBuilder(document, unused, Files::find).check_definition(*child);
        }
        check_unused(document, *child);
    }
}

void check_image_names(SceneFile& file) {
    std::map<std::pair<std::string, std::string>, std::string> writers;
    auto check = [&](scene::PictureName const& picture, SourceLocation const& where,
                     char const* tag) {
        auto const [it, fresh] = writers.emplace(std::pair(picture.folder, picture.name),
                                                 tag + (" at " + to_string(where)));
        if (!fresh)
            file.warnings.push_back(to_string(where) + ": writes the same picture '" +
                                    picture.name + ".exr' as the " + it->second);
    };
    for (scene::RenderJob const& job : file.jobs)
        if (!job.test) check({job.image_name, job.folder, {}, {}}, job.where, "integrator");
    for (scene::PostprocessJob const& job : file.postprocesses)
        if (!job.test)
            check(file.pictures[size_t(scene::pictures_of(job.postprocess).output.index)],
                  job.where, "postprocess");
}

SceneFile read_document(std::unique_ptr<XmlElement> root, std::vector<std::string> const& overrides,
                        std::shared_ptr<image::TextureCache> textures) {
    if (!textures) textures = std::make_shared<image::TextureCache>();
    SceneFile file;
    file.notes = modernise(*root);
    for (std::string const& o : overrides) apply_override(*root, o);
    if (!overrides.empty())
        for (std::string& note : modernise(*root)) file.notes.push_back(std::move(note));
    Document document{};
    document.root = std::move(root);
    document.textures = textures;
    index_ids(document);
    JobReader reader(document);
    std::vector<XmlElement const*> scenes;
    for (auto const& child : document.root->children) {
        if (child->tag == "integrator") {
            file.jobs.push_back(reader.read_integrator(*child));
        } else if (child->tag == "test") {
            reader.read_test(*child, file);
        } else if (child->tag == "scene") {
            scenes.push_back(child.get());
        } else if (child->tag == "postprocess") {
            file.postprocesses.push_back(reader.read_postprocess(*child, file.jobs.size()));
        } else if (!is_definition_tag(child->tag)) {
            throw InputError(child->where, "unknown tag <" + child->tag + ">" +
                                               suggestion(child->tag, root_tags()));
        } else if (child->get("id").empty()) {
            throw InputError(child->where, element_title(*child) +
                                               " outside of a scene expects an id: nothing can "
                                               "refer to it");
        }
    }
    if (file.jobs.empty() && file.postprocesses.empty()) {
        if (scenes.empty())
            throw InputError(document.root->where, "expected an <integrator>, <test>, "
                                                   "<postprocess> or <scene>, found none");
        if (scenes.size() > 1)
            throw InputError(scenes[1]->where,
                             "expected an <integrator> that refers to one of several scenes, "
                             "found none");
        file.jobs.push_back(reader.default_job(*scenes.front()));
    }
    for (XmlElement const* scene : scenes) reader.check_scene(*scene);
    check_unused(document, *document.root);
    for (size_t i = 0; i < document.pictures.size(); ++i) {
        XmlElement const& picture = *document.pictures[i];
        PlacedDisplay const& shown = document.displays[int32_t(i)];
        auto const& given = document.files[int32_t(i)];
        file.pictures.push_back({std::string(picture.get("id")), picture.folder, shown.display,
                                 shown.where, given.filename.path, given.linear});
    }
    check_image_names(file);
    for (std::string& warning : textures->take_warnings())
        file.warnings.push_back(std::move(warning));
    for (std::string& warning : document.warnings) file.warnings.push_back(std::move(warning));
    file.textures = std::move(textures);
    return file;
}

template <class Variant>
void add_schemas(std::vector<schema::Schema>& to) {
    for_each_type<Variant>([&]<class T>() { to.push_back(schema::schema_of<T>()); });
}

} // namespace

SceneFile read_scene_file(std::string const& path, std::vector<std::string> const& overrides,
                          std::shared_ptr<image::TextureCache> textures) {
    if (!is_gltf(path)) return read_document(read_xml(path), overrides, std::move(textures));
    if (!overrides.empty())
        throw InputError({path}, "expected an XML scene for --set " + overrides.front() +
                                     ", found a glTF file: write a scene with a group of it");
    return read_gltf_scene(path, std::move(textures));
}

SceneFile parse_scene(std::string_view text, std::string const& name, std::string const& folder,
                      std::vector<std::string> const& overrides,
                      std::shared_ptr<image::TextureCache> textures) {
    return read_document(parse_xml(text, name, folder), overrides, std::move(textures));
}

std::vector<schema::Schema> all_schemas() {
    std::vector<schema::Schema> all;
    all.push_back(schema::schema_of<scene::SceneContents>());
    add_schemas<scene::Camera>(all);
    all.push_back(schema::schema_of<scene::Instance>());
    add_schemas<scene::Shape>(all);
    add_schemas<scene::Material>(all);
    all.push_back(schema::schema_of<scene::Layer>());
    all.push_back(schema::schema_of<scene::LambertianEmission>());
    add_schemas<scene::Texture>(all);
    add_schemas<scene::Light>(all);
    all.push_back(schema::schema_of<scene::Portal>());
    all.push_back(schema::schema_of<scene::HomogeneousMedium>());
    all.push_back(schema::schema_of<scene::ConstantVolume>());
    add_schemas<scene::Sampler>(all);
    add_schemas<scene::Integrator>(all);
    all.push_back(schema::schema_of<scene::ImageOutput>());
    all.push_back(schema::schema_of<scene::Display>());
    add_schemas<scene::Postprocess>(all);
    all.push_back(schema::schema_of<scene::ImageTest>());
    return all;
}

} // namespace weft::io
