#include "post/ocio_view.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace weft::post {

namespace ocio = OCIO_NAMESPACE;

struct OcioView::Processor {
    ocio::ConstCPUProcessorRcPtr cpu;
};

namespace {

ocio::ConstConfigRcPtr read_config(std::string const& path) {
    if (!std::filesystem::is_regular_file(path))
        throw InputError({path}, "expected an OpenColorIO configuration, found no such file");
    try {
        return ocio::Config::CreateFromFile(path.c_str());
    } catch (ocio::Exception const& e) {
        std::string message = e.what();
        std::replace(message.begin(), message.end(), '\n', ' ');
        throw InputError({path}, "expected an OpenColorIO configuration, found: " + message);
    }
}

std::vector<std::string> display_names(ocio::Config const& config) {
    std::vector<std::string> names{config.getDefaultDisplay()};
    for (int i = 0; i < config.getNumDisplays(); ++i)
        if (std::string const name = config.getDisplay(i); name != names.front())
            names.push_back(name);
    return names;
}

std::vector<std::string> view_names(ocio::Config const& config, std::string const& display) {
    std::vector<std::string> names{config.getDefaultView(display.c_str())};
    for (int i = 0; i < config.getNumViews(display.c_str()); ++i)
        if (std::string const name = config.getView(display.c_str(), i); name != names.front())
            names.push_back(name);
    return names;
}

/// `wanted`, or the first where it is "". Throws where there is no such name.
std::string chosen(std::string const& wanted, std::vector<std::string> const& names,
                   std::string const& what, std::string const& config) {
    if (names.empty() || names.front().empty())
        throw InputError({config}, "expected a " + what + ", found none in the configuration");
    if (wanted.empty()) return names.front();
    if (std::find(names.begin(), names.end(), wanted) != names.end()) return wanted;
    throw InputError({config},
                     "no " + what + " is called '" + wanted + "'" + suggestion(wanted, names));
}

struct Input {
    std::string name;
    bool to_aces = false; ///< a matrix to ACES2065-1 comes first
    std::string warning;
};

Input find_input(ocio::Config const& config, OcioChoice const& choice) {
    if (!choice.input_space.empty()) {
        if (config.getColorSpace(choice.input_space.c_str()))
            return {choice.input_space, false, {}};
        std::vector<std::string> names;
        for (int i = 0; i < config.getNumColorSpaces(); ++i)
            names.emplace_back(config.getColorSpaceNameByIndex(i));
        chosen(choice.input_space, names, "colour space", choice.config);
    }
    constexpr std::array usual{"lin_rec709",
                               "lin_rec709_srgb",
                               "lin_srgb",
                               "Linear Rec.709 (sRGB)",
                               "Linear Rec.709",
                               "Utility - Linear - Rec.709",
                               "Utility - Linear - sRGB",
                               "Linear BT.709",
                               "Linear"};
    for (char const* name : usual)
        if (auto const space = config.getColorSpace(name)) return {space->getName(), false, {}};
    if (config.hasRole(ocio::ROLE_INTERCHANGE_SCENE))
        return {ocio::ROLE_INTERCHANGE_SCENE, true, {}};
    if (!config.hasRole(ocio::ROLE_SCENE_LINEAR))
        throw InputError({choice.config},
                         "expected a colour space for linear Rec. 709 light, found none; "
                         "'inputSpace' names it");
    return {ocio::ROLE_SCENE_LINEAR, false,
            choice.config +
                ": no colour space has a usual name for linear Rec. 709 light; its "
                "role scene_linear ('" +
                config.getColorSpace(ocio::ROLE_SCENE_LINEAR)->getName() +
                "') is taken for it: 'inputSpace' names another"};
}

/// Rec. 709 (D65) to ACES2065-1 (SMPTE ST 2065-1), adapted by Bradford's matrix.
ocio::MatrixTransformRcPtr aces_matrix() {
    constexpr std::array<double, 16> m{0.4396329819,
                                       0.3829886982,
                                       0.1773783199,
                                       0,
                                       0.0897764430,
                                       0.8134394287,
                                       0.0967841283,
                                       0,
                                       0.0175411704,
                                       0.1115465533,
                                       0.8709122763,
                                       0,
                                       0,
                                       0,
                                       0,
                                       1};
    auto matrix = ocio::MatrixTransform::Create();
    matrix->setMatrix(m.data());
    return matrix;
}

} // namespace

OcioView::OcioView(OcioChoice const& choice) {
    auto const config = read_config(choice.config);
    display_ = chosen(choice.display, display_names(*config), "display", choice.config);
    view_ = chosen(choice.view, view_names(*config, display_),
                   "view of the display '" + display_ + "'", choice.config);
    Input const input = find_input(*config, choice);
    input_space_ = input.name;
    warning_ = input.warning;
    auto transform = ocio::DisplayViewTransform::Create();
    transform->setSrc(input.name.c_str());
    transform->setDisplay(display_.c_str());
    transform->setView(view_.c_str());
    auto group = ocio::GroupTransform::Create();
    if (input.to_aces) group->appendTransform(aces_matrix());
    group->appendTransform(transform);
    try {
        auto processor = std::make_shared<Processor>();
        processor->cpu = config->getProcessor(group)->getDefaultCPUProcessor();
        processor_ = std::move(processor);
    } catch (ocio::Exception const& e) {
        throw InputError({choice.config}, "the view '" + view_ + "' of the display '" + display_ +
                                              "' cannot be used: " + e.what());
    }
}

void OcioView::apply(float* rgb, size_t count) const {
    if (count == 0) return;
    for (size_t i = 0; i < 3 * count; ++i) {
        constexpr float largest = 65504; // of a half: what tables and curves are made for
        rgb[i] = std::isnan(rgb[i]) ? 0 : std::clamp(rgb[i], -largest, largest);
    }
    ocio::PackedImageDesc pixels(rgb, long(count), 1, 3);
    processor_->cpu->apply(pixels);
}

std::vector<OcioDisplay> ocio_displays(std::string const& path) {
    auto const config = read_config(path);
    std::vector<OcioDisplay> result;
    for (std::string const& display : display_names(*config))
        result.push_back({display, view_names(*config, display)});
    return result;
}

} // namespace weft::post
