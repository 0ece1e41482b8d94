#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/waveguide/plane_section.h>
#include <vibrocontact/waveguide/track_loads.h>

#include <cmath>
#include <set>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  void check_patch(const SectionElements &elements, const double y, const double width)
  {
    const auto [from, to] = elements.extent(section_boundary::crown);
    if (y - width / 2 >= from - 1e-9 && y + width / 2 <= to + 1e-9)
      return;
    std::ostringstream text;
    text << "A patch from " << y - width / 2 << " to " << y + width / 2
         << " m across the rail leaves the crown, which reaches from " << from << " to " << to
         << " m: move it or make it narrower.";
    throw InputError(text.str());
  }

  void check_on_track(const PeriodicTrack &track, const double from, const double to)
  {
    const auto [begin, end] = track.reach();
    if (from > begin + 1e-9 && to < end - 1e-9)
      return;
    std::ostringstream text;
    text << "A place from x = " << from << " to " << to
         << " m is not on the rail, whose Supports carry it from " << begin << " to " << end
         << " m: give more Supports or places nearer by.";
    throw InputError(text.str());
  }

  namespace
  {
    /// of smooth shapes beyond loaded spans (doc/periodic_track.md has what it costs)
    constexpr double far_share = 0.7;
  } // namespace

  void keep_far_shapes(PeriodicTrack &track, const SectionShapes &shapes)
  {
    if (!track.own.empty())
      track.far_shapes = shapes_with_share(shapes, far_share);
  }

  namespace
  {
    /// int (y - centre)^power N_direction dy over the patch's width
    Vector<double> crown_load(const SectionElements &elements, const double y, const double width,
                              const unsigned int direction, const unsigned int power)
    {
      check_patch(elements, y, width);
      return elements.boundary_load(section_boundary::crown, y - width / 2, y + width / 2, direction, power,
                                    y);
    }
  } // namespace

  std::array<AxialLoad, 6> patch_motions(const SectionElements &elements, const SectionShapes &shapes,
                                         const double x, const double y, const double length,
                                         const double width)
  {
    std::array<AxialLoad, 6> motions;
    for (AxialLoad &motion : motions)
    {
      motion.centre = x;
      motion.length = length;
      motion.constant.reinit(shapes.n());
      motion.linear.reinit(shapes.n());
    }
    std::array<DenseVector, 3> mean, levered;
    for (unsigned int d = 0; d < 3; ++d)
    {
      mean[d] = shapes.reduced(crown_load(elements, y, width, d, 0));
      levered[d] = shapes.reduced(crown_load(elements, y, width, d, 1));
      motions[d].constant.add(1 / (length * width), mean[d]);
    }
    const double x_square = std::pow(length, 3) * width / 12, y_square = std::pow(width, 3) * length / 12;
    motions[3].constant.add(1 / y_square, levered[2]);
    motions[4].linear.add(-1 / x_square, mean[2]);
    motions[5].linear.add(1 / (x_square + y_square), mean[1]);
    motions[5].constant.add(-1 / (x_square + y_square), levered[0]);
    return motions;
  }

  SectionShapes track_shapes(const SectionElements &elements, const TrackSupport &support,
                             const std::vector<double> &patches, const double width,
                             const std::vector<Vector<double>> &others, const SmoothShapesSettings &settings)
  {
    const auto [from, to] = elements.extent(section_boundary::foot);
    std::vector<Vector<double>> loads = others;
    SparseMatrix<double> springs(elements.pattern), one(elements.pattern);
    const std::set<double> places(patches.begin(), patches.end());
    for (unsigned int d = 0; d < 3; ++d)
    {
      for (const double y : places)
        for (unsigned int power = 0; power < 2; ++power)
          loads.push_back(crown_load(elements, y, width, d, power));
      for (unsigned int power = 0; power < 4; ++power)
        loads.push_back(elements.boundary_load(section_boundary::foot, from, to, d, power, (from + to) / 2));
      one = 0;
      elements.boundary_springs(section_boundary::foot, d, one);
      springs.add(support.pad_stiffness[d] / (support.pad_length * (to - from)), one);
    }
    return smooth_shapes(elements, loads, springs, settings);
  }
} // namespace vibrocontact
