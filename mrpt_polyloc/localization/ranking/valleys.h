#pragma once

#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>
#include <mrpt_polyloc/localization/scan/ScoredPose.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// Which poses stand in one long uncertain valley of the cost: a corridor, along which a scan of
/// short range says nothing.
///
/// Two poses do if both are uncertain along the line between them (a standard deviation of 0.25 m
/// or more by the scan's information, see covarianceOfBeams()), if they lie on it (0.2 m and 4
/// degrees), at most 1.5 m apart, and if nowhere between them the cost rises by more than 0.01 m
/// above the dearer of both; and so do their neighbours in turn. Doors, even equal ones, hold a
/// pose along the corridor: then there is no valley.
/// \returns for each pose the least index of a pose in its valley: its own if it is in none
/// O(n^2) for n uncertain poses, and a few costs for each of them.
std::vector<std::size_t> valleysOf(const std::vector<ScoredPose>& poses, const ScanCost& cost,
                                   const BeamSectors& sectors);

/// Hypotheses of one valley become one: with the sum of their weights, at the one that is nearest
/// to their mean along the valley, with the covariance of all of them about it, and the z-score of
/// the best. \param hypotheses best first \param valley for each of them the number of its valley
/// \returns the heaviest first
std::vector<Hypothesis> uniteValleys(const std::vector<Hypothesis>& hypotheses,
                                     const std::vector<std::size_t>& valley);

}  // namespace mrpt_polyloc
