#include <vibrocontact/scene/section_manifolds.h>
#include <vibrocontact/waveguide/plane_section.h>

#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// The crown as a line of the plane section, see CrownManifold.
    class CrownLine : public FlatManifold<2>
    {
    public:
      explicit CrownLine(const std::vector<SectionOutline::Row> &rows) : rows(rows) {}
      std::unique_ptr<Manifold<2>> clone() const override { return std::make_unique<CrownLine>(rows); }
      Point<2> get_new_point(const ArrayView<const Point<2>> &points,
                             const ArrayView<const double> &weights) const override
      {
        const double a = FlatManifold<2>::get_new_point(points, weights)[0];
        return {a, CrownManifold::height(rows, a)};
      }

    private:
      const std::vector<SectionOutline::Row> rows;
    };
  } // namespace

  std::unique_ptr<Triangulation<2>> plane_section(const SectionMesh &mesh, const SectionOutline &outline)
  {
    auto plane = plane_cells(mesh);

    const unsigned int n = outline.rows.size(), crown_manifold = 1 + 2 * n;
    std::vector<SectionOutline::Row> crown;
    double crown_reach = 0;
    for (const auto &row : outline.rows)
      if (row.part == "crown")
      {
        crown.push_back(row);
        crown_reach = std::max({crown_reach, row.start[0], row.end[0]});
      }
    for (unsigned int k = 0; k < n; ++k)
      if (outline.rows[k].is_arc)
        for (const unsigned int side : {0, 1})
          plane->set_manifold(1 + k + side * n,
                              PolarManifold<2>(Point<2>((side == 0 ? 1. : -1.) * outline.rows[k].centre[0],
                                                        outline.rows[k].centre[1])));
    if (!crown.empty())
      plane->set_manifold(crown_manifold, CrownLine(crown));
    for (const auto &face : plane->active_face_iterators())
    {
      if (!face->at_boundary())
        continue;
      bool on_crown = !crown.empty(), on_foot = true;
      std::vector<Point<2>> right, left;
      for (const unsigned int v : {0, 1})
      {
        const Point<2> p = face->vertex(v);
        on_crown = on_crown && std::abs(p[0]) < crown_reach + 1e-7 &&
                   std::abs(p[1] - CrownManifold::height(crown, p[0])) < 1e-6;
        on_foot = on_foot && std::abs(p[1]) < 1e-7;
        right.push_back(p);
        left.emplace_back(-p[0], p[1]);
      }
      face->set_boundary_id(on_foot    ? section_boundary::foot
                            : on_crown ? section_boundary::crown
                                       : section_boundary::surface);
      const unsigned int k = outline.find(right), m = outline.find(left);
      if (on_crown)
        face->set_manifold_id(crown_manifold);
      else if (k < n && outline.rows[k].is_arc)
        face->set_manifold_id(1 + k);
      else if (m < n && outline.rows[m].is_arc)
        face->set_manifold_id(1 + m + n);
    }
    return plane;
  }
} // namespace vibrocontact
