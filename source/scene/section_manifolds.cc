#include <vibrocontact/scene/section_manifolds.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  Tensor<1, 3> RevolvedManifold::periodicity()
  {
    Tensor<1, 3> period;
    period[2] = 2 * numbers::PI;
    return period;
  }

  Point<3> RevolvedManifold::pull_back(const Point<3> &p) const
  {
    const double down = axis_height - p[2];
    double phi = std::atan2(p[0], down);
    if (phi < 0)
      phi += 2 * numbers::PI;
    return Point<3>(p[1] + shift, std::hypot(p[0], down), phi);
  }

  Point<3> RevolvedManifold::push_forward(const Point<3> &chart) const
  {
    return Point<3>(chart[1] * std::sin(chart[2]), chart[0] - shift,
                    axis_height - chart[1] * std::cos(chart[2]));
  }

  namespace
  {
    Tensor<1, 3> periods(const double second, const double third)
    {
      Tensor<1, 3> period;
      period[1] = second;
      period[2] = third;
      return period;
    }

    /// Angle in [0, 2 pi), as a periodic chart wants it.
    double positive_angle(const double b, const double a)
    {
      const double angle = std::atan2(b, a);
      return angle < 0 ? angle + 2 * numbers::PI : angle;
    }
  } // namespace

  RevolvedArcManifold::RevolvedArcManifold(const double axis_height, const double shift,
                                           const Point<2> &centre)
      : ChartManifold<3, 3, 3>(periods(2 * numbers::PI, 2 * numbers::PI)), axis_height(axis_height),
        shift(shift), revolved(axis_height, shift), centre(centre)
  {
  }

  RevolvedArcManifold::RevolvedArcManifold(const RevolvedArcManifold &other)
      : RevolvedArcManifold(other.axis_height, other.shift, other.centre)
  {
  }

  Point<3> RevolvedArcManifold::pull_back(const Point<3> &p) const
  {
    const Point<3> section = revolved.pull_back(p);
    const double a = section[0] - centre[0], b = section[1] - centre[1];
    return Point<3>(std::hypot(a, b), positive_angle(b, a), section[2]);
  }

  Point<3> RevolvedArcManifold::push_forward(const Point<3> &chart) const
  {
    return revolved.push_forward(Point<3>(centre[0] + chart[0] * std::cos(chart[1]),
                                          centre[1] + chart[0] * std::sin(chart[1]), chart[2]));
  }

  ExtrudedArcManifold::ExtrudedArcManifold(const Point<2> &centre)
      : ChartManifold<3, 3, 3>(periods(0, 2 * numbers::PI)), centre(centre)
  {
  }

  Point<3> ExtrudedArcManifold::pull_back(const Point<3> &p) const
  {
    const double a = p[1] - centre[0], b = p[2] - centre[1];
    return Point<3>(p[0], std::hypot(a, b), positive_angle(b, a));
  }

  Point<3> ExtrudedArcManifold::push_forward(const Point<3> &chart) const
  {
    return Point<3>(chart[0], centre[0] + chart[1] * std::cos(chart[2]),
                    centre[1] + chart[1] * std::sin(chart[2]));
  }

  double CrownManifold::height(const std::vector<SectionOutline::Row> &rows, const double a)
  {
    // The curve whose range holds |a|, or the nearest one gone on.
    const double y = std::abs(a);
    const SectionOutline::Row *best = &rows.front();
    double distance = 1e300;
    for (const auto &row : rows)
    {
      const double low = std::min(row.start[0], row.end[0]), high = std::max(row.start[0], row.end[0]);
      const double d = std::max({0., low - y, y - high});
      if (d < distance)
      {
        distance = d;
        best = &row;
      }
    }
    if (!best->is_arc)
    {
      const double width = best->end[0] - best->start[0];
      return best->start[1] +
             (width == 0 ? 0 : (y - best->start[0]) / width) * (best->end[1] - best->start[1]);
    }
    const double t = y - best->centre[0];
    return best->centre[1] + std::sqrt(best->radius * best->radius - t * t);
  }

  Point<3> CrownManifold::pull_back(const Point<3> &p) const
  {
    return Point<3>(p[0], p[1], p[2] - (height(rows, p[1] + shift_y) - shift_z));
  }

  Point<3> CrownManifold::push_forward(const Point<3> &chart) const
  {
    return Point<3>(chart[0], chart[1], chart[2] + (height(rows, chart[1] + shift_y) - shift_z));
  }

  std::unique_ptr<Triangulation<2>> plane_cells(const SectionMesh &section)
  {
    std::vector<CellData<2>> cells;
    for (unsigned int q = 0; q < section.cells.size(); ++q)
    {
      CellData<2> cell;
      std::copy(section.cells[q].begin(), section.cells[q].end(), cell.vertices.begin());
      cell.material_id = section.materials[q];
      cells.push_back(cell);
    }
    auto result = std::make_unique<Triangulation<2>>(Triangulation<2>::limit_level_difference_at_vertices);
    result->create_triangulation(section.vertices, cells, SubCellData());
    return result;
  }
} // namespace vibrocontact
