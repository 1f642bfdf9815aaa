#include "io/xml_document.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <pugixml.hpp>

namespace weft::io {

namespace fs = std::filesystem;

XmlAttribute const* XmlElement::find(std::string_view name) const {
    for (XmlAttribute const& a : attributes)
        if (a.name == name) return &a;
    return nullptr;
}

std::string_view XmlElement::get(std::string_view name) const {
    XmlAttribute const* a = find(name);
    return a ? std::string_view(a->value) : std::string_view();
}

namespace {

/// Nesting beyond this is an attack or an accident, and would exhaust the stack.
constexpr int kMaxNesting = 200;

class Builder {
  public:
    Builder(std::string text, std::string name, std::string folder, std::vector<fs::path>& open)
        : text_(std::move(text)), name_(std::move(name)), folder_(std::move(folder)), open_(open) {
        for (size_t i = 0; i < text_.size(); ++i)
            if (text_[i] == '\n') line_starts_.push_back(i + 1);
    }

    void build_into(XmlElement& parent) {
        pugi::xml_document document;
        auto const flags = pugi::parse_default | pugi::parse_ws_pcdata_single;
        auto const result = document.load_buffer(text_.data(), text_.size(), flags);
        if (!result)
            throw InputError(location(size_t(result.offset)),
                             std::string("malformed XML: ") + result.description());
        add_children(document, parent, 0);
    }

    SourceLocation location(size_t offset) const {
        auto const next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
        auto const line = next - line_starts_.begin();
        return {name_, int(line), int(offset - line_starts_[size_t(line - 1)]) + 1};
    }

  private:
    void add_children(pugi::xml_node const& from, XmlElement& to, int depth) {
        for (pugi::xml_node const& node : from.children()) {
            size_t const offset = node.offset_debug() > 0 ? size_t(node.offset_debug()) : 0;
            if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
                std::string_view const value = node.value();
                if (value.find_first_not_of(" \t\r\n") == std::string_view::npos) continue;
                throw InputError(location(offset), "expected a tag, found the text '" +
                                                       std::string(value.substr(0, 40)) + "'");
            }
            if (node.type() != pugi::node_element) continue;
            if (depth > kMaxNesting)
                throw InputError(location(offset), "tags are nested more than 200 deep");
            add_element(node, offset, to, depth);
        }
    }

    void add_element(pugi::xml_node const& node, size_t offset, XmlElement& parent, int depth) {
        auto element = std::make_unique<XmlElement>();
        element->tag = node.name();
        element->where = location(offset > 0 ? offset - 1 : 0); // pugixml points behind the '<'
        element->folder = folder_;
        size_t from = offset + element->tag.size();
        for (pugi::xml_attribute const& a : node.attributes()) {
            from = find_name(a.name(), from);
            element->attributes.push_back({a.name(), a.value(), location(from)});
            from += std::strlen(a.name());
        }
        for (size_t i = 0; i < element->attributes.size(); ++i)
            if (element->find(element->attributes[i].name) != &element->attributes[i])
                throw InputError(element->attributes[i].where,
                                 "'" + element->attributes[i].name + "' is given twice");
        if (element->tag == "include") {
            include(*element, parent);
            return;
        }
        add_children(node, *element, depth + 1);
        parent.children.push_back(std::move(element));
    }

    /// The offset at which an attribute's name stands: the parser keeps none, but attributes
    /// come in order, so it is the next place outside quotes where the name begins a word.
    size_t find_name(std::string_view name, size_t from) const {
        char quote = 0;
        for (size_t i = from; i < text_.size(); ++i) {
            char const c = text_[i];
            if (quote) {
                if (c == quote) quote = 0;
            } else if (c == '"' || c == '\'') {
                quote = c;
            } else if (text_.compare(i, name.size(), name) == 0) {
                return i;
            }
        }
        return from;
    }

    void include(XmlElement const& element, XmlElement& parent) {
        XmlAttribute const* file = element.find("filename");
        if (!file) throw InputError(element.where, "<include> expects filename=\"...\"");
        for (XmlAttribute const& a : element.attributes)
            if (a.name != "filename")
                throw InputError(a.where, "unknown parameter '" + a.name + "' of <include>; known: filename");
        fs::path const path = fs::path(folder_) / file->value;
        std::ifstream in(path, std::ios::binary);
        if (!in || fs::is_directory(path))
            throw InputError(file->where, "cannot include '" + file->value + "': expected a readable file at " + path.string());
        fs::path const canonical = fs::weakly_canonical(path);
        if (std::find(open_.begin(), open_.end(), canonical) != open_.end())
            throw InputError(file->where, "cyclic include: '" + file->value + "' is being read already");
        open_.push_back(canonical);
        std::string text((std::istreambuf_iterator<char>(in)), {});
        Builder(std::move(text), path.lexically_normal().string(), path.parent_path().string(), open_)
            .build_into(parent);
        open_.pop_back();
    }

    std::string text_, name_, folder_;
    std::vector<fs::path>& open_; ///< the chain of includes, to find cycles
    std::vector<size_t> line_starts_{0};
};

} // namespace

std::unique_ptr<XmlElement> parse_xml(std::string const& text, std::string const& name,
                                      std::string const& folder) {
    std::vector<fs::path> open{fs::weakly_canonical(name)};
    auto root = std::make_unique<XmlElement>();
    root->where = {name, 1, 1};
    root->folder = folder;
    Builder(text, name, folder, open).build_into(*root);
    return root;
}

std::unique_ptr<XmlElement> read_xml(std::string const& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in || fs::is_directory(path))
        throw InputError("cannot read '" + path + "': expected a readable scene file");
    std::string const text((std::istreambuf_iterator<char>(in)), {});
    return parse_xml(text, path, fs::path(path).parent_path().string());
}

} // namespace weft::io
