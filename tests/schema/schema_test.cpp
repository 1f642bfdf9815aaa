// The declarations of parameters: what is counted, read, written and documented.
#include "base/hash.h"
#include "schema/schema.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

using namespace weft;

namespace {

enum class Taste { sweet, sour };
constexpr auto choices(Taste) { return std::array<std::string_view, 2>{"sweet", "sour"}; }

struct FruitKind {
    static constexpr char const* category = "fruit";
};

struct Base {
    int count = 3;
    template <class F>
    constexpr void describe(F&& f) {
        f("count", count, {.min = 1, .max = 9, .help = "How many."});
    }
};

constexpr std::array kCakes{
    schema::Spelling{.type = "gateau", .today = "is <cake type=\"plain\"> today"},
    schema::Spelling{.parameter = "candles", .today = "is for birthdays"},
    schema::Spelling{.type = "torte", .parameter = "layers", .today = "is a pile of cakes"},
};

struct Cake {
    static constexpr schema::TypeInfo info{.category = "cake",
                                           .type = "plain",
                                           .help = "To eat.",
                                           .example = "<cake type=\"plain\"/>",
                                           .spellings = kCakes};
    Base base;
    float size = 0.1f;
    Color color{0.5f};
    Taste taste = Taste::sour;
    schema::Input<float> sugar{0.25f};
    schema::Id<FruitKind> fruit;
    std::vector<schema::Id<FruitKind>> more;
    schema::FileName recipe;
    Affined place;
    bool fresh = true;
    std::string note;

    template <class F>
    constexpr void describe(F&& f) {
        f.group(base);
        f("size", size,
          {.unit = "scene",
           .min = 0,
           .soft_max = 2,
           .help = "Radius.",
           .aliases = {"radius", schema::Alias("width", "that is twice as much")}});
        f("color", color, {.max = 1, .help = "Of the \"icing\"."});
        f("taste", taste, {.help = "Which."});
        f("sugar", sugar, {.help = "How much."});
        f("fruit", fruit, {.required = true, .help = "On top."});
        f("more", more, {.help = "Beside."});
        f("recipe", recipe, {.help = "A file."});
        f("place", place, {.help = "Where."});
        f("fresh", fresh, {.help = "Or not."});
        f("note", note, {.help = "A remark."});
    }
};

struct Complete {
    float a = 0;
    Base base;
    template <class F>
    constexpr void describe(F&& f) {
        f("a", a, schema::Attr{});
        f.group(base);
    }
};
struct Forgetful {
    float a = 0, b = 0;
    template <class F>
    constexpr void describe(F&& f) {
        f("a", a, schema::Attr{});
    }
};
struct ForgetsGroup {
    float a = 0;
    Base base;
    template <class F>
    constexpr void describe(F&& f) {
        f("a", a, schema::Attr{});
    }
};
struct Empty {
    template <class F>
    constexpr void describe(F&&) {}
};

static_assert(schema::all_described<Complete>);
static_assert(schema::all_described<Cake>);
static_assert(schema::all_described<Empty>);
#if !defined(__clang__) || __clang_major__ >= 16 // describe.h says why
static_assert(!schema::all_described<Forgetful>);
static_assert(!schema::all_described<ForgetsGroup>);
#endif
static_assert(schema::Choice<Taste> && !schema::Choice<int>);

schema::Field const& field(schema::Schema const& s, std::string_view name) {
    for (schema::Field const& f : s.fields)
        if (f.name == name) return f;
    throw std::out_of_range(std::string(name));
}

TEST(Schema, HoldsWhatIsDeclared) {
    schema::Schema const s = schema::schema_of<Cake>();
    EXPECT_EQ(s.info.type, "plain");
    ASSERT_EQ(s.fields.size(), 11u);
    EXPECT_EQ(s.fields[0].name, "count") << "a group's parameters stand where the group does";
    EXPECT_EQ(field(s, "count").kind, "integer");
    EXPECT_EQ(field(s, "count").default_value, "3");
    EXPECT_EQ(field(s, "count").attr.min, 1);
    EXPECT_EQ(field(s, "count").attr.max, 9);
    EXPECT_EQ(field(s, "size").kind, "float");
    EXPECT_EQ(field(s, "size").default_value, "0.1");
    EXPECT_EQ(field(s, "size").attr.unit, "scene");
    EXPECT_EQ(field(s, "size").attr.soft_max, 2);
    EXPECT_EQ(field(s, "color").default_value, "0.5");
    EXPECT_EQ(field(s, "taste").kind, "choice");
    EXPECT_EQ(field(s, "taste").default_value, "sour");
    EXPECT_EQ(field(s, "taste").choices, (std::vector<std::string>{"sweet", "sour"}));
    EXPECT_EQ(field(s, "sugar").kind, "float or texture");
    EXPECT_EQ(field(s, "sugar").category, "texture");
    EXPECT_EQ(field(s, "fruit").kind, "object");
    EXPECT_EQ(field(s, "fruit").category, "fruit");
    EXPECT_TRUE(field(s, "fruit").attr.required);
    EXPECT_EQ(field(s, "more").kind, "list");
    EXPECT_EQ(field(s, "recipe").kind, "file");
    EXPECT_EQ(field(s, "place").kind, "transform");
    EXPECT_EQ(field(s, "fresh").default_value, "true");
}

TEST(Schema, HelpSaysAll) {
    std::string const text = schema::help_text(schema::schema_of<Cake>());
    for (char const* part :
         {"<cake type=\"plain\">\nTo eat.\n", "count            integer, 1 .. 9, default 3\n",
          "size             float, >= 0 [scene], default 0.1\n", "Radius.",
          "color            color, <= 1, default 0.5\n", "sweet | sour, default sour\n",
          "fruit            <fruit>, default required\n",
          "more             any number of <fruit>, default none\n",
          "Example:\n  <cake type=\"plain\"/>\n", "Spellings of other dialects",
          "  type=\"gateau\"    is <cake type=\"plain\"> today\n",
          "  candles          is for birthdays\n", "  type=\"torte\" layers is a pile of cakes\n",
          "  radius           is called `size` today\n",
          "  width            is called `size` today: that is twice as much\n"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
}

TEST(Schema, ReferencePageHasOneRowPerParameter) {
    std::string const page = schema::reference_page("cake", {schema::schema_of<Cake>()});
    EXPECT_NE(page.find("| `count` | `integer` | 3 | 1 .. 9 |  | How many. |\n"), std::string::npos)
        << page;
    EXPECT_NE(page.find("| `taste` | `sweet, sour` | sour |"), std::string::npos) << page;
    std::istringstream lines(page);
    int rows = 0, other_spellings = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| `")) continue;
        bool const of_dialect = page.find("| spelling |") < page.find(line);
        EXPECT_EQ(std::count(line.begin(), line.end(), '|'), of_dialect ? 3 : 7) << line;
        ++(of_dialect ? other_spellings : rows);
    }
    EXPECT_EQ(rows, 11);
    EXPECT_EQ(other_spellings, 5);
    EXPECT_NE(page.find("| `type=\"gateau\"` | is `<cake type=\"plain\">` today |\n"),
              std::string::npos)
        << page;
}

TEST(Schema, JsonReadsBack) {
    auto const json = nlohmann::json::parse(schema::to_json({schema::schema_of<Cake>()}));
    EXPECT_EQ(json.at("version"), 1);
    auto const& type = json.at("types").at(0);
    EXPECT_EQ(type.at("category"), "cake");
    EXPECT_EQ(type.at("type"), "plain");
    auto const& parameters = type.at("parameters");
    ASSERT_EQ(parameters.size(), 11u);
    EXPECT_EQ(parameters[0].at("min"), 1);
    EXPECT_EQ(parameters[0].at("max"), 9);
    EXPECT_FALSE(parameters[1].contains("max")) << "no bound, no number";
    EXPECT_EQ(parameters[1].at("softMax"), 2);
    EXPECT_EQ(parameters[1].at("unit"), "scene");
    EXPECT_EQ(parameters[1].at("aliases"), (nlohmann::json{"radius", "width"}));
    EXPECT_FALSE(parameters[2].contains("aliases"));
    EXPECT_EQ(parameters[2].at("help"), "Of the \"icing\".");
    EXPECT_EQ(parameters[3].at("choices"), (nlohmann::json{"sweet", "sour"}));
    EXPECT_EQ(parameters[5].at("required"), true);
    EXPECT_EQ(parameters[5].at("category"), "fruit");
}

TEST(Schema, WritesWhatDiffersFromTheDefault) {
    Cake cake;
    EXPECT_EQ(schema::write_attributes(cake), "");
    cake.base.count = 4;
    cake.color = {1, 0.5f, 0};
    cake.taste = Taste::sweet;
    cake.fresh = false;
    cake.note = "a \"b\" <c> & d\n";
    EXPECT_EQ(schema::write_attributes(cake),
              " count=\"4\" color=\"1,0.5,0\" taste=\"sweet\" fresh=\"false\" "
              "note=\"a &quot;b&quot; &lt;c> &amp; d&#10;\"");
}

TEST(Text, EveryFloatSurvives) {
    Rng rng(1);
    int tested = 0;
    auto check = [&](float v) {
        float back = -1;
        EXPECT_TRUE(schema::TextForm<float>::read(schema::number_text(v), back)) << v;
        EXPECT_EQ(std::bit_cast<uint32_t>(v), std::bit_cast<uint32_t>(back)) << v;
        ++tested;
    };
    for (float v : {0.f, -0.f, 0.1f, 1e-6f, 16777216.f, std::numeric_limits<float>::max(),
                    std::numeric_limits<float>::min(), std::numeric_limits<float>::denorm_min()})
        check(v);
    for (int i = 0; i < 100000; ++i)
        if (float const v = std::bit_cast<float>(rng.next_uint()); std::isfinite(v)) check(v);
    EXPECT_GT(tested, 90000);
}

TEST(Text, EveryDoubleSurvives) {
    Rng rng(2);
    for (int i = 0; i < 100000; ++i) {
        uint64_t const high = rng.next_uint();
        double const v = std::bit_cast<double>(high << 32 | rng.next_uint());
        if (!std::isfinite(v)) continue;
        auto const back = schema::read_numbers(schema::number_text(v));
        ASSERT_TRUE(back && back->size() == 1) << v;
        EXPECT_EQ(back->front(), v);
    }
}

TEST(Text, NumbersAndWhatIsNone) {
    using Numbers = std::vector<double>;
    auto good = [](std::string_view text, Numbers const& expected) {
        auto const v = schema::read_numbers(text);
        ASSERT_TRUE(v) << text;
        EXPECT_EQ(*v, expected) << text;
    };
    good("", {});
    good("  \t\r\n", {});
    good("1", {1});
    good("+1,-2 , 3\t4\n5", {1, -2, 3, 4, 5});
    good("+.5 -.5 5. 1e2 1E-2 +1e+2", {0.5, -0.5, 5, 100, 0.01, 100});
    good("1e308", {1e308});
    for (char const* bad :
         {",",     "1,",     ",1",        "1,,2", "1;2",   "1.5abc", "abc",      "1-2",
          "++1",   "+-1",    "-+1",       "--1",  "+",     "-",      ".",        "e5",
          "1e",    "1e+",    "0x10",      "nan",  "inf",   "-inf",   "infinity", "nan(1)",
          "1e999", "-1e999", "1 2 three", "1..2", "1_000", "1'000",  "½"})
        EXPECT_FALSE(schema::read_numbers(bad)) << bad;
    EXPECT_FALSE(schema::read_numbers(std::string_view("1\0", 2)));
}

TEST(Text, ComponentsMustBeOneOrAll) {
    EXPECT_EQ(schema::read_components("2", 3), (std::vector<double>{2, 2, 2}));
    EXPECT_EQ(schema::read_components("1 2 3", 3), (std::vector<double>{1, 2, 3}));
    EXPECT_FALSE(schema::read_components("1 2", 3));
    EXPECT_FALSE(schema::read_components("1 2 3 4", 3));
    EXPECT_FALSE(schema::read_components("", 3));
    EXPECT_FALSE(schema::read_components("1 2", 1));
    EXPECT_TRUE(schema::read_components("3.4e38", 1));
    EXPECT_FALSE(schema::read_components("3.5e38", 1)) << "a float would be infinite";
}

TEST(Text, Integers) {
    auto read = [](std::string_view text) {
        int v = -12345;
        return schema::TextForm<int>::read(text, v) ? v : -12345;
    };
    EXPECT_EQ(read(" 42 "), 42);
    EXPECT_EQ(read("+7"), 7);
    EXPECT_EQ(read("-7"), -7);
    EXPECT_EQ(read("2147483647"), 2147483647);
    for (char const* bad :
         {"", "+", "+-7", "--7", "4.0", "4e1", "2147483648", "0x10", "4 5", "four"})
        EXPECT_EQ(read(bad), -12345) << bad;
}

TEST(Text, BooleansAndChoices) {
    for (auto const& [text, value] : std::vector<std::pair<std::string, bool>>{{"true", true},
                                                                               {"1", true},
                                                                               {"yes", true},
                                                                               {"false", false},
                                                                               {"0", false},
                                                                               {"no", false}}) {
        bool v = !value;
        EXPECT_TRUE(schema::TextForm<bool>::read(text, v));
        EXPECT_EQ(v, value);
    }
    bool flag = true;
    for (char const* bad : {"", "2", "True", "on", "true "})
        EXPECT_FALSE(schema::TextForm<bool>::read(bad, flag)) << bad;
    Taste taste = Taste::sour;
    EXPECT_TRUE(schema::TextForm<Taste>::read("sweet", taste));
    EXPECT_EQ(taste, Taste::sweet);
    for (char const* bad : {"", "Sweet", "bitter"})
        EXPECT_FALSE(schema::TextForm<Taste>::read(bad, taste)) << bad;
    EXPECT_EQ(taste, Taste::sweet) << "a refused text changes nothing";
}

TEST(Text, VectorsColoursAndTransforms) {
    Rng rng(3);
    auto number = [&] { return (rng.next() - 0.5f) * 1e3f; };
    for (int i = 0; i < 1000; ++i) {
        Color const c(number(), number(), number());
        Color c_back;
        EXPECT_TRUE(schema::TextForm<Color>::read(schema::TextForm<Color>::write(c), c_back));
        EXPECT_EQ(c, c_back);
        Vec3 const v(number(), number(), number());
        Vec3 v_back;
        EXPECT_TRUE(schema::TextForm<Vec3>::read(schema::TextForm<Vec3>::write(v), v_back));
        EXPECT_EQ(v, v_back);
        Affined m;
        for (Vec3d* column : {&m.x, &m.y, &m.z, &m.origin})
            *column = Vec3d(number(), number(), number()) / 3.0;
        Affined m_back;
        EXPECT_TRUE(schema::TextForm<Affined>::read(schema::TextForm<Affined>::write(m), m_back));
        EXPECT_EQ(m, m_back);
    }
    EXPECT_EQ(schema::TextForm<Color>::write(Color(0.5f)), "0.5");
    EXPECT_EQ(schema::TextForm<Affined>::write(Affined()), "") << "the identity needs no words";
}

} // namespace
