#include "io/convert.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <unordered_map>

#include "io/modernise.h"
#include "io/scene_file.h"

namespace weft::io {

namespace fs = std::filesystem;

namespace {

/// Writes a tree that was changed since it was read, with the text that did not.
class Writer {
  public:
    /// To be made before the tree is changed.
    Writer(XmlElement const& root, std::string_view text)
        : text_(without_byte_order_mark(text)), out_(text.substr(0, text.size() - text_.size())) {
        remember(root);
    }

    std::string write(XmlElement const& root) {
        contents(root, "\n", 0);
        return std::move(out_);
    }

  private:
    struct Span {
        size_t begin, end;
    };

    void remember(XmlElement const& element) {
        std::vector<Span>& spans = spans_[&element];
        for (auto const& child : element.children) {
            spans.push_back({child->text.begin, child->text.end});
            remember(*child);
        }
    }

    std::string_view slice(size_t begin, size_t end) const {
        return text_.substr(begin, end > begin ? end - begin : 0);
    }

    /// The line break and indentation before an element of the file; "" where others stand in its
    /// line.
    std::string_view margin_of(XmlElement const& element) const {
        if (element.text.end == 0) return "";
        size_t const begin = text_.find_last_not_of(" \t", element.text.begin - 1) + 1;
        bool const own_line = element.text.begin > 0 && begin > 0 && text_[begin - 1] == '\n';
        return own_line ? slice(begin - 1, element.text.begin) : std::string_view();
    }

    void element(XmlElement const& e, std::string_view margin) {
        bool const in_file = e.text.end != 0;
        bool const was_empty = !in_file || e.text.closing == e.text.end;
        bool const is_empty = was_empty && e.children.empty();
        if (in_file && !e.edited && was_empty == is_empty) {
            out_ += slice(e.text.begin, e.text.inside);
        } else {
            out_ += "<" + e.tag;
            for (XmlAttribute const& a : e.attributes)
                out_ += " " + a.name + "=\"" + schema::xml_text(a.value) + "\"";
            out_ += is_empty ? "/>" : ">";
        }
        if (is_empty) return;
        contents(e, margin, 2);
        if (was_empty)
            out_ += std::string(margin) + "</" + e.tag + ">";
        else if (e.edited)
            out_ += "</" + e.tag + ">";
        else
            out_ += slice(e.text.closing, e.text.end);
    }

    /// What stands inside of an element: its children of today, and between those of the file what
    /// stood there.
    void contents(XmlElement const& e, std::string_view margin, size_t deeper) {
        static std::vector<Span> const none;
        auto const found = spans_.find(&e);
        std::vector<Span> const& spans = found == spans_.end() ? none : found->second;
        std::string inner(margin.empty() ? "" : std::string(margin) + std::string(deeper, ' '));
        for (auto const& child : e.children)
            if (auto const own = margin_of(*child); !own.empty() && is_in(*child, spans)) {
                inner = own;
                break;
            }
        size_t at = e.text.inside, next = 0;
        auto const skip_to = [&](size_t span) { // elements that are gone, and what is between them
            for (; next < span; ++next) {
                std::string_view const gap = slice(at, spans[next].begin);
                out_ += gap.substr(0, gap.find_last_not_of(" \t\r\n") + 1); // comments
                at = spans[next].end;
            }
        };
        for (auto const& child : e.children) {
            size_t const span =
                size_t(std::find_if(spans.begin() + std::ptrdiff_t(next), spans.end(),
                                    [&](Span const& s) {
                                        return child->text.end && s.begin == child->text.begin;
                                    }) -
                       spans.begin());
            if (span == spans.size()) {
                out_ += inner;
                element(*child, inner);
                continue;
            }
            skip_to(span);
            out_ += slice(at, spans[span].begin);
            element(*child, margin_of(*child));
            at = spans[span].end;
            next = span + 1;
        }
        skip_to(spans.size());
        if (e.text.end != 0) out_ += slice(at, e.text.closing);
    }

    static bool is_in(XmlElement const& child, std::vector<Span> const& spans) {
        return child.text.end != 0 && std::any_of(spans.begin(), spans.end(), [&](Span const& s) {
                   return s.begin == child.text.begin;
               });
    }

    std::string_view text_;
    std::string out_;
    std::unordered_map<XmlElement const*, std::vector<Span>> spans_;
};

/// The parameters that hold file names, by "category type".
std::multimap<std::string, std::string> file_parameters() {
    std::multimap<std::string, std::string> names{{"include ", "filename"}};
    for (schema::Schema const& s : all_schemas())
        for (schema::Field const& field : s.fields)
            if (field.kind == schema::TextForm<schema::FileName>::kind)
                names.emplace(std::string(s.info.category) + " " + std::string(s.info.type),
                              field.name);
    return names;
}

/// Makes relative file names lead from `to` to where they led from `from`.
void move_names(XmlElement& element, fs::path const& from, fs::path const& to,
                std::multimap<std::string, std::string> const& names) {
    auto const [first, last] =
        names.equal_range(element.tag + " " + std::string(element.get("type")));
    for (auto it = first; it != last; ++it)
        if (std::string const name = schema::parameter_text(element, it->second);
            !name.empty() && fs::path(name).is_relative())
            schema::set_parameter(
                element, it->second,
                (from / name).lexically_normal().lexically_proximate(to).string());
    for (auto const& child : element.children) move_names(*child, from, to, names);
}

bool is_equal(XmlElement const& a, XmlElement const& b) {
    auto const same = [](XmlAttribute const& x, XmlAttribute const& y) {
        return x.name == y.name && x.value == y.value;
    };
    return a.tag == b.tag &&
           std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(),
                      b.attributes.end(), same) &&
           std::equal(a.children.begin(), a.children.end(), b.children.begin(), b.children.end(),
                      [](auto const& x, auto const& y) { return is_equal(*x, *y); });
}

void note_includes(XmlElement const& element, std::vector<std::string>& notes) {
    if (element.tag == "include")
        notes.push_back(to_string(element.where) + ": " + in_quotes(element.get("filename")) +
                        " is a file of its own, and is not converted");
    for (auto const& child : element.children) note_includes(*child, notes);
}

} // namespace

Converted convert_scene(std::string_view text, std::string const& old_path,
                        std::string const& new_path) {
    auto const root = parse_xml_as_written(text, old_path);
    Writer writer(*root, text);
    Converted result;
    result.notes = modernise(*root);
    note_includes(*root, result.notes);
    fs::path const from = fs::weakly_canonical(fs::absolute(old_path)).parent_path();
    fs::path const to = fs::weakly_canonical(fs::absolute(new_path)).parent_path();
    if (from != to) move_names(*root, from, to, file_parameters());
    result.text = writer.write(*root);
    // Whatever the layout of the old text: the new one says what the tree says, or none is written.
    if (!is_equal(*root, *parse_xml_as_written(result.text, old_path)))
        throw InputError({old_path},
                         "cannot write this file in today's words without changing what "
                         "it says");
    return result;
}

} // namespace weft::io
