#include "io/modernise.h"

#include <cmath>
#include <set>
#include <unordered_map>

#include "io/scene_file.h"
#include "io/transform_reader.h"

namespace weft::io {

namespace {

struct ParameterAlias {
    schema::Alias alias;
    std::string today;
};

/// The rules for one type, or for one word that used to be a type.
struct TypeRules {
    std::string_view type; ///< today's
    std::vector<schema::Spelling> spellings;
    std::vector<ParameterAlias> aliases;
};

/// By "category type"; types without rules are not in it. Categories that have one type without a
/// name are in it as "category ".
using Rules = std::unordered_map<std::string, TypeRules>;

std::string key_of(std::string_view category, std::string_view type) {
    return std::string(category) + " " + std::string(type);
}

Rules make_rules() {
    Rules rules;
    for (schema::Schema const& s : all_schemas()) {
        TypeRules own{s.info.type, {}, {}};
        for (schema::Spelling const& spelling : s.info.spellings) {
            if (spelling.type.empty()) {
                own.spellings.push_back(spelling);
                continue;
            }
            TypeRules& old = rules[key_of(s.info.category, spelling.type)];
            old.type = s.info.type;
            old.spellings.push_back(spelling);
        }
        for (schema::Field const& field : s.fields)
            for (schema::Alias const& alias : field.attr.aliases)
                own.aliases.push_back({alias, field.name});
        if (!own.spellings.empty() || !own.aliases.empty())
            rules[key_of(s.info.category, s.info.type)] = std::move(own);
    }
    return rules;
}

class Moderniser final : public schema::Surroundings {
  public:
    explicit Moderniser(XmlElement& root) : rules_(shared_rules()), root_(root) {}

    /// Looks through the whole tree, which rules change: few of them ask.
    XmlElement* resolve(XmlElement& element) const override {
        return element.tag == "ref" ? find(root_, element.get("id")) : &element;
    }

    std::optional<double> scale_of(XmlElement& instance) const override {
        Affined m;
        if (XmlAttribute const* a = instance.find("transform"))
            schema::TextForm<Affined>::read(a->value, m);
        for (auto const& child : instance.children)
            if (XmlElement* part = resolve(*child); part && part->tag == "transform")
                m = read_transform(*part);
        double const x = length(m.x), y = length(m.y), z = length(m.z);
        auto const differ = [&](double a, double b) { return std::abs(a - b) > 1e-4 * x; };
        auto const lean = [&](Vec3d const& a, Vec3d const& b) {
            return std::abs(dot(a, b)) > 1e-4 * x * x;
        };
        if (differ(x, y) || differ(x, z) || lean(m.x, m.y) || lean(m.x, m.z) || lean(m.y, m.z))
            return {};
        return x;
    }

    void visit(XmlElement& element) {
        if (schema::is_property_tag(element.tag) || element.tag == "ref") return;
        // A rule may make another type of an element, which has rules of its own.
        for (int steps = 0; steps < kMostSteps && rewrite(element); ++steps) {
        }
        // Rules may add, take out and move children.
        for (size_t i = 0; i < element.children.size(); ++i) visit(*element.children[i]);
    }

    std::vector<std::string> take_notes() { return std::move(notes_); }

  private:
    static constexpr int kMostSteps = 10;

    static Rules const& shared_rules() {
        static Rules const rules = make_rules();
        return rules;
    }

    static XmlElement* find(XmlElement& in, std::string_view id) {
        for (auto const& child : in.children) {
            if (child->tag != "ref" && child->get("id") == id) return child.get();
            if (XmlElement* found = find(*child, id)) return found;
        }
        return nullptr;
    }

    TypeRules const* rules_for(XmlElement const& element) const {
        std::string_view const type = element.get("type");
        auto found = rules_.find(key_of(element.tag, type));
        // "default" is lightwave's word for the one type of a category.
        if (found == rules_.end() && type == "default")
            found = rules_.find(key_of(element.tag, ""));
        return found == rules_.end() ? nullptr : &found->second;
    }

    /// Applies what applies to the element as it is. Returns whether its type has changed.
    bool rewrite(XmlElement& element) {
        TypeRules const* const rules = rules_for(element);
        if (!rules) return false;
        std::string const type(element.get("type"));
        for (schema::Spelling const& spelling : rules->spellings) {
            apply(element, *rules, spelling);
            if (element.get("type") != type) return true;
        }
        for (ParameterAlias const& alias : rules->aliases) rename(element, alias);
        return false;
    }

    void apply(XmlElement& element, TypeRules const& rules, schema::Spelling const& spelling) {
        if (!spelling.parameter.empty() && !schema::has_parameter(element, spelling.parameter))
            return;
        bool const by_type = !spelling.type.empty();
        std::string const title = schema::element_title(element);
        SourceLocation const where = by_type && element.find("type")
                                         ? element.find("type")->where
                                         : schema::parameter_place(element, spelling.parameter);
        if (!spelling.rewrite) {
            if (by_type)
                element.set("type", std::string(rules.type));
            else
                schema::erase_parameter(element, spelling.parameter);
        } else if (!spelling.rewrite(element, *this)) {
            return;
        }
        // What a rule leaves of the old type is today's.
        if (by_type && element.get("type") == spelling.type)
            element.set("type", std::string(rules.type));
        std::string const subject =
            by_type ? title : in_quotes(spelling.parameter) + " of " + title;
        note(where, subject + " " + std::string(spelling.today));
    }

    void rename(XmlElement& element, ParameterAlias const& rule) {
        std::string_view const name = rule.alias.name;
        if (!schema::has_parameter(element, name)) return;
        SourceLocation const where = schema::parameter_place(element, name);
        std::string const subject = in_quotes(name) + " of " + schema::element_title(element);
        if (schema::has_parameter(element, rule.today))
            throw InputError(where, subject + " is called " + in_quotes(rule.today) +
                                        " today, which is given, too");
        if (rule.alias.convert) {
            XmlAttribute* const value = schema::parameter_value(element, name);
            auto converted = value ? rule.alias.convert(value->value) : std::nullopt;
            if (!converted)
                throw InputError(where, subject + " is " + in_quotes(rule.today) +
                                            " today, measured otherwise; expected a number to "
                                            "convert");
            schema::set_parameter(element, name, std::move(*converted));
        }
        schema::rename_parameter(element, name, rule.today);
        note(where, subject + " " + schema::alias_text(rule.alias, rule.today));
    }

    /// One for each file and rule.
    void note(SourceLocation const& where, std::string const& text) {
        if (told_.emplace(where.file, text).second)
            notes_.push_back(to_string(where) + ": " + text);
    }

    Rules const& rules_;
    XmlElement& root_;
    std::set<std::pair<std::string, std::string>> told_;
    std::vector<std::string> notes_;
};

} // namespace

std::vector<std::string> modernise(XmlElement& root) {
    Moderniser moderniser(root);
    moderniser.visit(root);
    return moderniser.take_notes();
}

} // namespace weft::io
