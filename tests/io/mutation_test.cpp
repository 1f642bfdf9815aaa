// Damaged files, by the thousand: whatever the bytes, a reader returns something valid or throws
// InputError. The fuzzers in tests/fuzz look deeper; this runs everywhere in a few seconds.
#include "base/hash.h"
#include "io/ply.h"
#include "io/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace weft;
namespace fs = std::filesystem;

namespace {

constexpr int kMutations = 20000;

std::vector<std::string> read_corpus(char const* name) {
    std::vector<fs::path> paths;
    for (auto const& e :
         fs::directory_iterator(fs::path(WEFT_SOURCE_DIR) / "tests/fuzz/corpus" / name))
        paths.push_back(e.path());
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> texts;
    for (fs::path const& path : paths) {
        std::ifstream in(path, std::ios::binary);
        texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return texts;
}

/// One to four edits: a byte set, changed or added, a part cut out, doubled, or taken from another
/// file; or a digit changed, which often leaves a file that can be read.
std::string mutate(std::string text, std::vector<std::string> const& corpus, Rng& rng) {
    using namespace std::string_view_literals; // for the zero byte
    static constexpr auto bytes = "\0\t\n\r \"&',-./0123456789:;<=>aefinx\x7f\x80\xff"sv;
    auto below = [&](size_t n) { return std::min(size_t(rng.next() * float(n)), n - 1); };
    for (size_t edits = 1 + below(4); edits > 0; --edits) {
        size_t const at = below(text.size() + 1), length = below(24);
        std::string const& other = corpus[below(corpus.size())];
        switch (below(8)) {
        case 0:
            text.insert(at, 1, bytes[below(bytes.size())]);
            break;
        case 1:
            text.replace(at, 1, 1, bytes[below(bytes.size())]);
            break;
        case 2:
            text.erase(at, length);
            break;
        case 3:
            text.insert(at, text.substr(below(text.size() + 1), length));
            break;
        case 4:
            text.insert(at, other.substr(below(other.size() + 1), length * 4));
            break;
        default:
            if (size_t const digit = text.find_first_of("0123456789", at); digit < text.size())
                text[digit] = char('0' + below(10));
        }
    }
    return text;
}

struct Outcome {
    int accepted = 0, refused = 0;
};

/// Calls `read` with each mutation; anything thrown but InputError ends the test.
template <class Read>
Outcome try_mutations(char const* name, uint32_t seed, Read const& read) {
    auto const corpus = read_corpus(name);
    Rng rng(seed);
    Outcome outcome;
    for (int i = 0; i < kMutations; ++i) {
        std::string const text = mutate(corpus[size_t(i) % corpus.size()], corpus, rng);
        try {
            read(text);
            ++outcome.accepted;
        } catch (InputError const& e) {
            ++outcome.refused;
            EXPECT_EQ(std::string_view(e.what()).find('\n'), std::string_view::npos) << e.what();
        }
    }
    return outcome;
}

TEST(Mutations, SceneReader) {
    Outcome const outcome = try_mutations("scene", 1, [](std::string const& text) {
        io::SceneFile const file = io::parse_scene(text, "mutated.xml", "/nonexistent");
        EXPECT_FALSE(file.jobs.empty());
    });
    // Both happen, or the mutations test nothing.
    EXPECT_GT(outcome.accepted, kMutations / 100);
    EXPECT_GT(outcome.refused, kMutations / 2);
}

TEST(Mutations, PlyReader) {
    Outcome const outcome = try_mutations("ply", 2, [](std::string const& text) {
        scene::validate(io::read_ply(text, "mutated.ply"), {"mutated.ply"});
    });
    EXPECT_GT(outcome.accepted, kMutations / 100);
    EXPECT_GT(outcome.refused, kMutations / 2);
}

} // namespace
