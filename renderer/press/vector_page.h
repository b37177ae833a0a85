#pragma once

#include <glm/vec2.hpp>
#include <string>

namespace belvedere {

constexpr double points_per_mm = 72.0 / 25.4;

// An SVG file as one page of PDF of that size, its drawing stretched over it: text and lines stay
// vectors, fonts are embedded. Error(input) where it is missing or not SVG.
std::string svg_as_pdf(const std::string& path, glm::dvec2 size_mm);

}  // namespace belvedere
