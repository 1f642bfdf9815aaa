#include "io/xml_document.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "base/file_bytes.h"
#include "io/material_library.h"

namespace weft::io {

namespace fs = std::filesystem;

namespace {

/// Files that include one another several times over grow exponentially.
constexpr int kMaxIncludes = 10000;
constexpr size_t kMaxIncludedBytes = size_t(1) << 30;

/// What the files of one document share while they are read.
struct Includes {
    std::vector<fs::path> open; ///< the chain of files being read, to find cycles
    int files = 0;
    size_t bytes = 0;
    std::map<std::string, std::string, std::less<>> defaults; ///< what `${name}` stands for
    bool as_written = false;
};

fs::path canonical(std::string const& path) {
    std::error_code error;
    fs::path const result = fs::weakly_canonical(path, error);
    return error ? fs::path(path) : result;
}

/// One file on its way into the tree.
class Builder {
  public:
    Builder(std::string_view text, std::string name, std::string folder, Includes& includes)
        : text_(without_byte_order_mark(text)), name_(std::move(name)), folder_(std::move(folder)),
          includes_(includes) {
        for (size_t i = 0; i < text_.size(); ++i)
            if (text_[i] == '\n') line_starts_.push_back(i + 1);
    }

    void build_into(XmlElement& parent, int depth) {
        if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
            throw InputError({name_, 1, 1}, "expected text in UTF-8, found UTF-16");
        if (size_t const zero = text_.find('\0'); zero != std::string_view::npos)
            throw InputError(location(zero), "malformed XML: expected text, found a zero byte");
        pugi::xml_document document;
        // As a fragment, a document may hold several objects, and text between them is seen.
        auto const flags = pugi::parse_default | pugi::parse_fragment;
        auto const result =
            document.load_buffer(text_.data(), text_.size(), flags, pugi::encoding_utf8);
        if (!result)
            throw InputError(location(size_t(result.offset)),
                             std::string("malformed XML: ") + result.description());
        add_children(document, parent, depth);
    }

  private:
    SourceLocation location(size_t offset) const {
        auto const next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
        auto const line = next - line_starts_.begin();
        return {name_, int(line), int(offset - line_starts_[size_t(line - 1)]) + 1};
    }

    void add_children(pugi::xml_node const& from, XmlElement& to, int depth) {
        for (pugi::xml_node const& node : from.children()) {
            size_t const offset = node.offset_debug() > 0 ? size_t(node.offset_debug()) : 0;
            if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
                std::string_view text = node.value();
                size_t const start = text.find_first_not_of(" \t\r\n");
                if (start == std::string_view::npos) continue;
                text.remove_prefix(start);
                throw InputError(
                    location(text_.find_first_not_of(" \t\r\n", offset)),
                    "expected a tag, found the text " +
                        in_quotes(text.substr(0, text.find_last_not_of(" \t\r\n") + 1)));
            }
            if (node.type() == pugi::node_element) add_element(node, offset, to, depth);
        }
    }

    void add_element(pugi::xml_node const& node, size_t offset, XmlElement& parent, int depth) {
        auto element = std::make_unique<XmlElement>();
        element->tag = node.name();
        size_t const tag_length = element->tag.size();
        if (element->tag == "node") element->tag = "texture";   // two words for one thing
        element->where = location(offset > 0 ? offset - 1 : 0); // pugixml points behind the '<'
        element->folder = folder_;
        if (depth > kMaxNesting)
            throw InputError(element->where, "expected tags nested at most " +
                                                 std::to_string(kMaxNesting) + " deep, found more");
        size_t from = offset + tag_length;
        std::set<std::string_view> names;
        for (pugi::xml_attribute const& a : node.attributes()) {
            std::string_view const name = a.name();
            from = find_name(name, from);
            if (!names.insert(name).second)
                throw InputError(location(from), in_quotes(name) + " is given twice");
            element->attributes.push_back(
                {std::string(name), resolved(a.value(), from), location(from)});
            from += name.size();
        }
        bool const wraps = element->tag == "lightwave" && !includes_.as_written;
        add_children(node, wraps ? parent : *element, depth + 1);
        if (includes_.as_written) {
            element->text = range_of(*element, offset > 0 ? offset - 1 : 0);
            parent.children.push_back(std::move(element));
        } else if (element->tag == "include") {
            include(*element, parent, depth);
        } else if (element->tag == "default") {
            add_default(*element);
        } else if (!wraps) {
            parent.children.push_back(std::move(element));
        }
    }

    /// The text with what its `${name}` stand for.
    std::string resolved(std::string text, size_t offset) const {
        if (includes_.as_written) return text;
        for (size_t at = 0; (at = text.find("${", at)) != std::string::npos;) {
            size_t const end = text.find('}', at);
            std::string const name =
                text.substr(at + 2, end == std::string::npos ? end : end - at - 2);
            auto const found = includes_.defaults.find(name);
            if (end == std::string::npos || found == includes_.defaults.end())
                throw InputError(location(offset), "nothing says what " +
                                                       in_quotes("${" + name + "}") +
                                                       " stands for: expected <default name=\"" +
                                                       "...\" value=\"...\"/> before it");
            text.replace(at, end + 1 - at, found->second);
            at += found->second.size();
        }
        return text;
    }

    void add_default(XmlElement const& element) {
        for (char const* name : {"name", "value"})
            if (!element.find(name))
                throw InputError(element.where, "<default> expects name=\"...\" and value=\"...\"");
        for (XmlAttribute const& a : element.attributes)
            if (a.name != "name" && a.name != "value")
                throw InputError(a.where, "unknown parameter " + in_quotes(a.name) +
                                              " of <default>; known: name, value");
        includes_.defaults.emplace(element.get("name"), element.get("value"));
    }

    /// Where an element stands whose '<' is at `begin`, and whose children know where they do.
    schema::TextRange range_of(XmlElement const& element, size_t begin) const {
        schema::TextRange range{begin, behind_tag(begin), 0, 0};
        if (range.inside >= 2 && text_[range.inside - 2] == '/') {
            range.closing = range.end = range.inside;
            return range;
        }
        size_t at = element.children.empty() ? range.inside : element.children.back()->text.end;
        while ((at = std::min(text_.find('<', at), text_.size())) < text_.size() &&
               !text_.substr(at).starts_with("</"))
            at = behind_markup(at);
        range.closing = at;
        range.end = behind_tag(at);
        return range;
    }
    /// Behind the '>' of the tag that begins at `at`; what stands in quotes does not end it.
    size_t behind_tag(size_t at) const {
        char quote = 0;
        for (; at < text_.size(); ++at) {
            char const c = text_[at];
            if (quote ? c == quote : c == '"' || c == '\'') quote = quote ? 0 : c;
            if (!quote && c == '>') return at + 1;
        }
        return at;
    }
    /// Behind a comment, a processing instruction or whatever else begins at `at`.
    size_t behind_markup(size_t at) const {
        static constexpr std::array<std::array<std::string_view, 2>, 3> kinds{
            {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}};
        for (auto const& [opening, closing] : kinds)
            if (text_.substr(at).starts_with(opening)) {
                size_t const end = text_.find(closing, at + opening.size());
                return end == std::string_view::npos ? text_.size() : end + closing.size();
            }
        return at + 1;
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
            } else if (text_.substr(i, name.size()) == name) {
                return i;
            }
        }
        return from;
    }

    bool exists(std::string const& file) const {
        std::error_code error;
        return fs::exists(fs::path(folder_.str()) / file, error);
    }

    void include(XmlElement const& element, XmlElement& parent, int depth) {
        XmlAttribute const* file = element.find("filename");
        if (!file) throw InputError(element.where, "<include> expects filename=\"...\"");
        for (XmlAttribute const& a : element.attributes)
            if (a.name != "filename")
                throw InputError(a.where, "unknown parameter " + in_quotes(a.name) +
                                              " of <include>; known: filename");
        if (!element.children.empty())
            throw InputError(element.children.front()->where,
                             "<include> has no child tags, found <" +
                                 element.children.front()->tag + ">");
        // What does not lie beside the file may be a material that the program carries.
        auto const carried = exists(file->value) ? std::nullopt : library_text(file->value);
        std::string const path =
            carried ? file->value : existing_file(folder_, file->value, file->where);
        fs::path const same = canonical(path);
        if (std::find(includes_.open.begin(), includes_.open.end(), same) != includes_.open.end())
            throw InputError(file->where, "cyclic include: " + in_quotes(file->value) +
                                              " is being read already");
        FileBytes const bytes = carried ? FileBytes({}, 0) : read_file(path);
        std::string_view const text = carried.value_or(bytes.view());
        includes_.bytes += text.size();
        if (++includes_.files > kMaxIncludes || includes_.bytes > kMaxIncludedBytes)
            throw InputError(file->where, "expected at most " + std::to_string(kMaxIncludes) +
                                              " includes of 1 GiB together, found more");
        includes_.open.push_back(same);
        Builder(text, path, fs::path(path).parent_path().string(), includes_)
            .build_into(parent, depth);
        includes_.open.pop_back();
    }

    std::string_view text_;
    SharedText name_, folder_;
    Includes& includes_;
    std::vector<size_t> line_starts_{0};
};

} // namespace

std::string_view without_byte_order_mark(std::string_view text) {
    return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

std::unique_ptr<XmlElement> parse_xml_as_written(std::string_view text, std::string const& name) {
    Includes includes;
    includes.as_written = true;
    auto root = std::make_unique<XmlElement>();
    root->where = {name, 1, 1};
    size_t const size = without_byte_order_mark(text).size();
    root->text = {0, 0, size, size};
    Builder(text, name, fs::path(name).parent_path().string(), includes).build_into(*root, 1);
    return root;
}

std::unique_ptr<XmlElement> parse_xml(std::string_view text, std::string const& name,
                                      std::string const& folder) {
    Includes includes;
    includes.open = {canonical(name)};
    auto root = std::make_unique<XmlElement>();
    root->where = {name, 1, 1};
    root->folder = folder;
    Builder(text, name, folder, includes).build_into(*root, 1);
    return root;
}

std::unique_ptr<XmlElement> read_xml(std::string const& path) {
    FileBytes const bytes = read_file(path);
    return parse_xml(bytes.view(), path, fs::path(path).parent_path().string());
}

std::string existing_file(std::string const& folder, std::string const& file,
                          SourceLocation const& where) {
    fs::path const path = (fs::path(folder) / file).lexically_normal();
    std::error_code error;
    fs::file_status const status = fs::status(path, error);
    if (fs::is_regular_file(status)) return path.string();
    throw InputError(where, "expected a file at " + in_quotes(path.string()) + ", found " +
                                (fs::is_directory(status) ? "a folder"
                                 : fs::exists(status)     ? "a device or pipe"
                                                          : "none"));
}

} // namespace weft::io
