// Files of weights: what is in them, what is wrong with them, and where they are looked for.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "post/weights.h"
#include "tests/post/pictures.h"
#include "tests/support/scenes.h"

namespace weft::post {
namespace {

using namespace weft::testing;

TEST(Weights, FloatsAndHalvesReadBack) {
    Weights weights;
    weights["b.weight"] = {{2, 1, 1, 3}, {0, -1.5f, 0.25f, 1024, -6.5e4f, 1}};
    weights["a"] = {{2}, {3, -4}};
    for (bool half : {false, true}) {
        SCOPED_TRACE(half);
        Weights const read = parse_weights(weights_bytes(weights, half), "w.tza");
        ASSERT_EQ(read.size(), 2u);
        for (auto const& [name, tensor] : weights) {
            EXPECT_EQ(read.at(name).dims, tensor.dims);
            for (size_t i = 0; i < tensor.values.size(); ++i)
                EXPECT_NEAR(read.at(name).values[i], tensor.values[i],
                            half ? std::abs(tensor.values[i]) / 2048 : 0);
        }
    }
}

std::string message(std::string const& bytes) {
    try {
        parse_weights(bytes, "w.tza");
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

TEST(Weights, DamagedFilesAreRefused) {
    std::string const good = weights_bytes({{"a", {{3}, {1, 2, 3}}}});
    auto const expected = [](std::string const& what) {
        return "w.tza: expected weights of a network (.tza): " + what;
    };
    EXPECT_EQ(message(good), "no error");
    for (size_t length = 0; length < good.size(); ++length)
        EXPECT_EQ(message(good.substr(0, length)).find(expected("")), 0u) << length;
    auto changed = [&](size_t at, char to) {
        std::string bytes = good;
        bytes[at] = to;
        return bytes;
    };
    EXPECT_EQ(message(changed(0, 'x')), expected("the file begins otherwise"));
    EXPECT_EQ(message(changed(2, 1)), expected("expected version 2 of the format, found 1"));
    EXPECT_EQ(message(changed(10, 1)),
              expected("expected an offset in the file, found one beyond its end"));
    size_t const layout = good.size() - 10;
    EXPECT_EQ(message(changed(layout, 'y')), expected("unknown layout 'y'"));
    EXPECT_EQ(message(changed(layout + 1, 'd')), expected("unknown type of number"));
    EXPECT_EQ(message(changed(layout - 1, '\x7f')), expected("expected a tensor of sensible size"));
    for (size_t at = 0; at < good.size(); ++at)
        for (int bit = 0; bit < 8; ++bit) message(changed(at, char(good[at] ^ (1 << bit))));
}

/// Sets a variable of the environment, and back again.
class Variable {
  public:
    Variable(char const* name, char const* value) : name_(name) {
        if (char const* old = std::getenv(name)) old_ = old;
        if (value)
            setenv(name, value, 1);
        else
            unsetenv(name);
    }
    ~Variable() {
        if (old_)
            setenv(name_, old_->c_str(), 1);
        else
            unsetenv(name_);
    }
    Variable(Variable const&) = delete;
    Variable& operator=(Variable const&) = delete;

  private:
    char const* name_;
    std::optional<std::string> old_;
};

TEST(Weights, AreLookedForWhereThePageSays) {
    Variable const home("HOME", "/h");
    {
        Variable const own("WEFT_WEIGHTS", "/w"), data("XDG_DATA_HOME", "/d"),
            shared("XDG_DATA_DIRS", "/s:/t");
        auto const folders = weight_folders("/first");
        ASSERT_EQ(folders.size(), 6u);
        EXPECT_EQ(folders[0], "/first");
        EXPECT_EQ(folders[1], "/w");
        EXPECT_EQ(folders[2], "/d/weft/weights");
        EXPECT_TRUE(folders[3].ends_with("/share/weft/weights")) << folders[3];
        EXPECT_EQ(folders[4], "/s/weft/weights");
        EXPECT_EQ(folders[5], "/t/weft/weights");
    }
    {
        Variable const own("WEFT_WEIGHTS", nullptr), data("XDG_DATA_HOME", nullptr),
            shared("XDG_DATA_DIRS", nullptr);
        auto const folders = weight_folders();
        ASSERT_EQ(folders.size(), 4u);
        EXPECT_EQ(folders[0], "/h/.local/share/weft/weights");
        EXPECT_EQ(folders[2], "/usr/local/share/weft/weights");
        EXPECT_EQ(folders[3], "/usr/share/weft/weights");
    }
}

TEST(Weights, TheFirstFolderThatHasThemWins) {
    TemporaryFolder const folder;
    for (char const* name : {"a", "b", "c"}) std::filesystem::create_directory(folder / name);
    for (char const* name : {"b/w.tza", "c/w.tza"}) std::ofstream(folder / name) << "x";
    std::filesystem::create_directory(folder / "a/w.tza");
    EXPECT_EQ(find_weights("w.tza", {folder / "a", folder / "b", folder / "c"}),
              folder / "b/w.tza");
    EXPECT_EQ(find_weights("v.tza", {folder / "a", folder / "b"}), "");
}

} // namespace
} // namespace weft::post
