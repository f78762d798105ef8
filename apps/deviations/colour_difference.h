// Colours as people see them, and how far apart two of them look.
#pragma once

#include <Eigen/Core>

namespace scattermeter::apps {

// CIE L*, a*, b* of a linear sRGB colour (IEC 61966-2-1; white: D65). Values may exceed 1; negative
// ones count as 0.
Eigen::Vector3d lab_from_linear_srgb(const Eigen::Vector3d& rgb);

// CIEDE2000 of two colours in L*, a*, b*, with all weights 1; 1 is about what can just be told
// apart. Sharma, Wu and Dalal, The CIEDE2000 color-difference formula (Color Research and
// Application 30, 2005), eq. 2 to 22.
double ciede2000(const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2);

}  // namespace scattermeter::apps
