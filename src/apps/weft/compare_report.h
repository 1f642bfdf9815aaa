// The page that `weft compare --report` writes: one HTML file without any other, which shows
// pictures of a scene against each other in a browser.
//
// A picture is in it as a PNG of 8-bit numbers that hold halves of 8 significant bits: the upper
// bytes in the PNG's upper half, the lower ones below. The page so exposes over all of a half's
// range, and a probed value is right to 0.4 %.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace weft::apps {

/// A number of the table.
struct ReportMetric {
    std::string name, help;
    int digits = 0;     ///< after the point; 0: as a power of ten
    bool whole = false; ///< a count
};

struct ReportPicture {
    std::string path;
    image::Image light;          ///< linear; the first three channels or the first are shown
    std::vector<double> metrics; ///< one for each ReportMetric; none of the reference
    image::Image flip;           ///< its map of errors; no pixels of the reference
};

struct Report {
    std::vector<ReportMetric> metrics;
    std::vector<ReportPicture> pictures; ///< of one size; the last is the reference
    std::string flip_kind;               ///< "LDR-FLIP" or "HDR-FLIP"
    std::string note;                    ///< what there is to know about the numbers
};

/// Writes the page in one step. Throws IoError.
void write_report(std::string const& path, Report const& report);

/// Returns the text of compare_report.html, which has @DATA@ in the place of the pictures.
std::string_view report_page();

} // namespace weft::apps
