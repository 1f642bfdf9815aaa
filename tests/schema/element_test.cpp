// Elements: parameters in all their spellings, and edits.
#include "schema/element.h"

#include <gtest/gtest.h>

using namespace weft;
using schema::Element;

namespace {

/// <bsdf type="x" a="1"><float name="b" value="2"/><texture name="c" type="constant"
/// value="1,2,3"/> <texture name="d" type="image"/><transform/></bsdf>
Element bsdf() {
    Element e;
    e.tag = "bsdf";
    e.attributes = {{"type", "x", {"f", 1, 7}}, {"a", "1", {"f", 1, 16}}};
    auto child = [&](std::string tag, std::vector<schema::Attribute> attributes) {
        Element& added = e.add(tag);
        added.attributes = std::move(attributes);
        added.where = {"f", 2, 1};
    };
    child("float", {{"name", "b", {"f", 2, 1}}, {"value", "2", {"f", 2, 9}}});
    child("texture", {{"name", "c", {}}, {"type", "constant", {}}, {"value", "1,2,3", {}}});
    child("texture", {{"name", "d", {}}, {"type", "image", {}}});
    child("transform", {});
    return e;
}

} // namespace

TEST(Element, ParametersInAllTheirSpellings) {
    Element e = bsdf();
    for (char const* name : {"a", "b", "c", "d", "transform"})
        EXPECT_TRUE(has_parameter(e, name)) << name;
    EXPECT_FALSE(has_parameter(e, "e"));
    EXPECT_EQ(schema::parameter_number(e, "a"), 1);
    EXPECT_EQ(schema::parameter_number(e, "b"), 2);
    EXPECT_EQ(schema::parameter_number(e, "c"), std::nullopt) << "it has three";
    EXPECT_EQ(schema::parameter_color(e, "c"), Color(1, 2, 3));
    EXPECT_EQ(schema::parameter_color(e, "b"), Color(2));
    EXPECT_EQ(schema::parameter_value(e, "d"), nullptr) << "a picture has no value";
    EXPECT_EQ(schema::parameter_text(e, "e"), "");
    EXPECT_EQ(schema::parameter_place(e, "a").column, 16);
    EXPECT_EQ(schema::parameter_place(e, "b").line, 2);
    EXPECT_EQ(schema::element_title(e), "<bsdf type=\"x\">");
}

TEST(Element, EditsReachEverySpelling) {
    Element e = bsdf();
    EXPECT_FALSE(e.edited);
    for (auto const& [name, other] : {std::pair("a", "A"), {"b", "B"}, {"c", "C"}}) {
        std::string const text = schema::parameter_text(e, name);
        rename_parameter(e, name, other);
        EXPECT_FALSE(has_parameter(e, name)) << name;
        EXPECT_EQ(schema::parameter_text(e, other), text);
    }
    EXPECT_TRUE(e.edited);
    set_parameter(e, "C", "4");
    EXPECT_EQ(e.get("C"), "4");
    EXPECT_EQ(schema::parameter_child(e, "C"), nullptr);
    for (char const* name : {"A", "B", "C", "d"}) {
        erase_parameter(e, name);
        EXPECT_FALSE(has_parameter(e, name)) << name;
    }
    ASSERT_EQ(e.children.size(), 1u);
    Element const& transform = *e.children[0];
    EXPECT_NE(e.take(transform), nullptr);
    EXPECT_EQ(e.take(e), nullptr) << "no child of its own";
    EXPECT_TRUE(e.children.empty());
}

TEST(Element, ErasingWhatIsNotThereIsNoEdit) {
    Element e = bsdf();
    e.erase("e");
    erase_parameter(e, "e");
    EXPECT_FALSE(e.edited);
}
