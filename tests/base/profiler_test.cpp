// Features of threads, and what a profiler makes of them.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/profiler.h"

namespace weft {
namespace {

/// Of the calling thread.
double processor_seconds() {
    timespec t = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

void work_for(double seconds) {
    double const end = processor_seconds() + seconds;
    while (processor_seconds() < end) {
    }
}

double sum(Profile const& p) { return std::accumulate(p.seconds.begin(), p.seconds.end(), 0.0); }
double share(Profile const& p, Feature f) { return p.seconds[size_t(f)] / sum(p); }

/// Five standard deviations (significance 6e-7) of a share that samples tell. Times between looks
/// vary, which at most doubles the variance.
double tolerance(Profile const& p, double share) {
    return 5 * std::sqrt(2 * share * (1 - share) / double(p.samples));
}

TEST(FeatureScope, NestsAndRestores) {
    EXPECT_EQ(current_feature(), Feature::Integration);
    {
        FeatureScope const outer(Feature::Shading);
        EXPECT_EQ(current_feature(), Feature::Shading);
        {
            FeatureScope const inner(Feature::Textures);
            EXPECT_EQ(current_feature(), Feature::Textures);
        }
        EXPECT_EQ(current_feature(), Feature::Shading);
        EXPECT_THROW(
            {
                FeatureScope const inner(Feature::Media);
                throw std::runtime_error("");
            },
            std::runtime_error);
        EXPECT_EQ(current_feature(), Feature::Shading);
    }
    EXPECT_EQ(current_feature(), Feature::Integration);
}

TEST(FeatureScope, IsTheThreadsOwn) {
    FeatureScope const here(Feature::Film);
    Feature there = Feature::Film, inside = Feature::Film;
    std::thread([&] {
        there = current_feature();
        FeatureScope const scope(Feature::Camera);
        inside = current_feature();
    }).join();
    EXPECT_EQ(there, Feature::Integration);
    EXPECT_EQ(inside, Feature::Camera);
    EXPECT_EQ(current_feature(), Feature::Film);
}

TEST(FeatureName, EveryFeatureHasItsOwn) {
    std::set<std::string_view> names;
    for (size_t i = 0; i < kFeatures; ++i) names.insert(feature_name(Feature(i)));
    EXPECT_EQ(names.size(), kFeatures);
    EXPECT_FALSE(names.contains(""));
    EXPECT_EQ(feature_name(Feature::Film), "film");
}

TEST(Profiler, TellsTheSharesOfInnermostScopes) {
    Profiler profiler;
    {
        Profiler::Work const work(&profiler);
        // The last look is just over when the work ends: hardly anything comes after it.
        while (profiler.profile().samples < 1000) {
            FeatureScope const outer(Feature::Shading);
            work_for(0.3e-3);
            FeatureScope const inner(Feature::Textures);
            work_for(0.1e-3);
        }
    }
    Profile const p = profiler.profile();
    EXPECT_NEAR(share(p, Feature::Textures), 0.25, tolerance(p, 0.25));
    EXPECT_NEAR(share(p, Feature::Shading), 0.75, tolerance(p, 0.75));
    EXPECT_NEAR(sum(p), p.processor_seconds, 0.05 * p.processor_seconds);
}

TEST(Profiler, AddsUpThreads) {
    Profiler profiler;
    auto const work = [&](Feature feature, double seconds) {
        Profiler::Work const at_work(&profiler);
        FeatureScope const scope(feature);
        work_for(seconds);
    };
    std::thread a(work, Feature::ClosestHits, 0.4), b(work, Feature::Film, 0.2),
        c(work, Feature::Film, 0.2);
    a.join();
    b.join();
    c.join();
    Profile const p = profiler.profile();
    // What comes after the last look is lost, and nothing else is, however late that was.
    double const lost = p.processor_seconds - sum(p);
    EXPECT_GE(lost, -1e-9);
    EXPECT_GE(p.seconds[size_t(Feature::ClosestHits)], 0.4 - lost - 1e-9);
    EXPECT_GE(p.seconds[size_t(Feature::Film)], 0.4 - lost - 1e-9);
    EXPECT_GE(p.processor_seconds, 0.8);
    EXPECT_LE(p.processor_seconds, 0.9);
}

TEST(Profiler, WorkInManyShortPiecesIsNotLost) {
    Profiler profiler;
    int pieces = 0;
    for (; profiler.profile().samples < 200; ++pieces) {
        work_for(0.1e-3);                          // nobody's
        FeatureScope const scope(Feature::Camera); // while work begins and ends, too
        Profiler::Work const work(&profiler);
        work_for(0.1e-3);
    }
    Profile const p = profiler.profile();
    EXPECT_GE(p.processor_seconds, pieces * 0.1e-3);
    EXPECT_LE(p.processor_seconds, pieces * 0.15e-3);
    EXPECT_NEAR(sum(p), p.processor_seconds, 0.05 * p.processor_seconds);
    EXPECT_EQ(share(p, Feature::Camera), 1) << "what lies between is nobody's";
}

TEST(Profiler, WaitingTakesNoTime) {
    Profiler profiler;
    {
        Profiler::Work const work(&profiler);
        {
            FeatureScope const scope(Feature::Textures);
            std::this_thread::sleep_for(std::chrono::milliseconds(300));
        }
        work_for(0.1);
    }
    Profile const p = profiler.profile();
    EXPECT_LT(p.seconds[size_t(Feature::Textures)], 0.01);
    EXPECT_NEAR(p.processor_seconds, 0.1, 0.02);
}

TEST(Profiler, NoProfilerIsNoWork) { Profiler::Work const work(nullptr); }

TEST(Profile, AddsUp) {
    Profile a, b;
    a.seconds[1] = 1;
    a.samples = 10;
    a.processor_seconds = 2;
    a.thread_seconds = 3;
    b.seconds[1] = 0.5;
    b.seconds[2] = 4;
    b.samples = 7;
    a += b;
    a += b;
    EXPECT_EQ(a.seconds[1], 2);
    EXPECT_EQ(a.seconds[2], 8);
    EXPECT_EQ(a.samples, 24u);
    EXPECT_EQ(a.processor_seconds, 2);
    EXPECT_EQ(a.thread_seconds, 3);
}

} // namespace
} // namespace weft
