#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>
#include <mrpt_polyloc/localization/scan/BeamEvidenceParams.h>

#include <mrpt/math/CMatrixFixed.h>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT HypothesisParams {
  double merge_distance = 0.2;               ///< poses nearer than this are one hypothesis [m] ...
  double merge_angle = 0.06981317007977318;  ///< ... if their headings are, too [rad], 4 degrees
  /// A difference of the mean evidence counts in units of its standard error, that of the beams and
  /// that of the map: walls do not stand quite where the map has them, and so many beams on few
  /// walls err together. This much in any map [m] ...
  double indifference = 0.002;
  /// ... and this share of the side of the cells that the map was traced from.
  double cell_share = 0.4;
  /// Walls are off by so much of that side from where they stand, mostly: a beam that is off by no
  /// more says nothing against a pose (BeamEvidenceParams::tolerance, unless one is given there).
  /// Only what goes beyond 0.05 m counts, in quadrature, here and in the next two.
  double tolerance_share = 0.8;
  /// Where walls are off, so is the pose: its standard deviations have so much of that in them,
  /// of the position [m/m] and the heading [rad/m].
  double position_share = 0.45;
  double heading_share = 0.11;
  /// That side [m]; 0: what the map says (PolygonMap::cellSize()), for localizers fill it in.
  double cell_size = 0.0;
  /// Whether hypotheses that stand in one long uncertain valley are returned as one, with a long
  /// covariance; only if SearchOptions::unite_valleys says so as well.
  bool unite_valleys = true;
  BeamEvidenceParams evidence;  ///< by which hypotheses are ranked and weighed
  Calibration calibration;

  /// These for a map: its cell size is filled in if none is given, and the tolerance of the
  /// evidence.
  HypothesisParams of(const PolygonMap& map) const;

  /// The standard error of a difference of means that comes from the map [m].
  double mapError() const;

  /// A pose's covariance (x, y, phi), with what comes from the map's cells.
  mrpt::math::CMatrixDouble33 withMapError(const mrpt::math::CMatrixDouble33& covariance) const;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
