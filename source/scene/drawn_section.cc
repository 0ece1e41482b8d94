#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/drawn_section.h>
#include <vibrocontact/scene/gmsh_library.h>

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    bool are_one(const Point<2> &p, const Point<2> &q)
    {
      return p.distance(q) < section_resolution;
    }

    std::string in_mm(const Point<2> &p)
    {
      return "(" + number_text(1e3 * p[0]) + ", " + number_text(1e3 * p[1]) + ") mm";
    }

    double cross(const Tensor<1, 2> &u, const Tensor<1, 2> &v)
    {
      return u[0] * v[1] - u[1] * v[0];
    }

    struct Segment
    {
      Point<2> from, to;
      unsigned int loop;
    };

    /// Straight pieces of all curves.
    std::vector<Segment> segments(const std::vector<OutlineLoop> &loops)
    {
      constexpr unsigned int per_arc = 8;
      std::vector<Segment> result;
      for (unsigned int l = 0; l < loops.size(); ++l)
        for (const SectionOutline::Row &row : loops[l].rows)
        {
          Point<2> from = row.start;
          const Tensor<1, 2> u = row.start - row.centre, v = row.end - row.centre;
          const double turn = row.is_arc ? std::atan2(cross(u, v), u * v) : 0;
          for (unsigned int k = 1; k <= (row.is_arc ? per_arc : 1u); ++k)
          {
            const double c = std::cos(turn * k / per_arc), s = std::sin(turn * k / per_arc);
            const bool last = !row.is_arc || k == per_arc;
            const Point<2> to =
                last ? row.end : row.centre + Tensor<1, 2>({c * u[0] - s * u[1], s * u[0] + c * u[1]});
            result.push_back({from, to, l});
            from = to;
          }
        }
      return result;
    }

    /// Where two segments meet otherwise than at common ends. Those of two regions may run along each other.
    bool meet(const Segment &a, const Segment &b, Point<2> &place)
    {
      const Tensor<1, 2> u = a.to - a.from, v = b.to - b.from, w = b.from - a.from;
      const double area = cross(u, v);
      const bool parallel = std::abs(area) < 1e-9 * u.norm() * v.norm();
      if (parallel)
      {
        if (a.loop != b.loop || std::abs(cross(u, w)) > section_resolution * u.norm())
          return false;
        // of one loop: any length in common
        const double first = w * u / u.norm(), second = first + v * u / u.norm(),
                     low = std::max(0., std::min(first, second)),
                     high = std::min(u.norm(), std::max(first, second));
        place = a.from + low / u.norm() * u;
        return high - low > section_resolution;
      }
      const double s = cross(w, v) / area, t = cross(w, u) / area, at_a = section_resolution / u.norm(),
                   at_b = section_resolution / v.norm();
      place = a.from + s * u;
      const bool on_a = s > -at_a && s<1 + at_a, on_b = t> - at_b && t<1 + at_b, inside_a = s> at_a &&
                        s<1 - at_a, inside_b = t> at_b && t < 1 - at_b;
      // a region may have a corner on the edge of another one
      return a.loop == b.loop ? (on_a && on_b && (inside_a || inside_b)) : inside_a && inside_b;
    }

    /// Strictly inside, by the number of crossings of a ray.
    bool is_inside(const Point<2> &p, const std::vector<Segment> &all, const unsigned int loop)
    {
      bool inside = false;
      for (const Segment &s : all)
        if (s.loop == loop && (s.from[1] > p[1]) != (s.to[1] > p[1]) &&
            p[0] < s.from[0] + (p[1] - s.from[1]) / (s.to[1] - s.from[1]) * (s.to[0] - s.from[0]))
          inside = !inside;
      return inside;
    }

    std::string region_text(const OutlineLoop &loop)
    {
      return loop.region.empty() ? "" : " of region " + loop.region;
    }

    void check_crossings(const std::vector<OutlineLoop> &loops, const std::string &file)
    {
      const std::vector<Segment> all = segments(loops);
      Point<2> place;
      for (unsigned int i = 0; i < all.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          if (meet(all[j], all[i], place))
          {
            const OutlineLoop &a = loops[all[j].loop], &b = loops[all[i].loop];
            if (all[i].loop == all[j].loop)
              throw InputError("The section outline " + file + region_text(a) + " overlaps itself at " +
                               in_mm(place) + ": draw it once around, without crossing its own line.");
            throw InputError("Regions " + a.region + " and " + b.region + " of the section outline " + file +
                             " cross at " + in_mm(place) + ": let them share an edge or keep apart.");
          }
      // without crossings one lies in the other if a point just inside one of its edges does
      for (const Segment &s : all)
      {
        const Tensor<1, 2> along = s.to - s.from;
        for (const double side : {1e-3, -1e-3})
        {
          const Point<2> p = s.from + 0.5 * along + side * Tensor<1, 2>({-along[1], along[0]});
          for (unsigned int l = 0; l < loops.size() && is_inside(p, all, s.loop); ++l)
            if (l != s.loop && is_inside(p, all, l))
              throw InputError("Regions " + loops[s.loop].region + " and " + loops[l].region +
                               " of the section outline " + file + " overlap at " + in_mm(p) +
                               ": every place belongs to one of them.");
        }
      }
    }

    /// gmsh as long as it lives.
    struct Gmsh
    {
      Gmsh() { start_gmsh(); }
      ~Gmsh() { gmsh::finalize(); }
      Gmsh(const Gmsh &) = delete;
      Gmsh &operator=(const Gmsh &) = delete;
    };

    /// The geometry of some loops in gmsh: equal points and curves are made once.
    class Drawing
    {
    public:
      Drawing(const std::vector<OutlineLoop> &loops, const double size) : size(size)
      {
        for (const OutlineLoop &loop : loops)
          for (const SectionOutline::Row &row : loop.rows)
            point(row.start);
        n_corners = points.size();
      }

      void add(const OutlineLoop &loop, const unsigned int group)
      {
        std::vector<int> curves;
        for (const SectionOutline::Row &row : loop.rows)
          if (row.is_arc)
            curves.push_back(curve(point(row.start), point(row.end), point(row.centre)));
          else
          {
            // a corner of another region splits the line
            std::map<double, unsigned int> along;
            const Tensor<1, 2> u = row.end - row.start;
            for (unsigned int k = 0; k < n_corners; ++k)
            {
              const double s = (points[k] - row.start) * u / u.norm_square();
              if (s > section_resolution / u.norm() && s < 1 - section_resolution / u.norm() &&
                  std::abs(cross(u, points[k] - row.start)) < section_resolution * u.norm())
                along[s] = k;
            }
            unsigned int last = point(row.start);
            along[1.] = point(row.end);
            for (const auto &[s, k] : along)
            {
              curves.push_back(curve(last, k, no_centre));
              last = k;
            }
          }
        const int surface = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(curves)});
        groups[group].push_back(surface);
      }

      const std::map<unsigned int, std::vector<int>> &surfaces() const { return groups; }

    private:
      static constexpr unsigned int no_centre = -1;

      unsigned int point(const Point<2> &p)
      {
        const auto found =
            std::find_if(points.begin(), points.end(), [&](const Point<2> &q) { return are_one(p, q); });
        if (found == points.end())
        {
          gmsh::model::geo::addPoint(p[0], p[1], 0., size, points.size() + 1);
          points.push_back(p);
          return points.size() - 1;
        }
        return found - points.begin();
      }

      /// Negative: it has been made the other way round.
      int curve(const unsigned int from, const unsigned int to, const unsigned int centre)
      {
        const std::array<unsigned int, 3> key = {{from, to, centre}}, other = {{to, from, centre}};
        const auto same = made.find(key), reverse = made.find(other);
        if (same != made.end())
          return same->second;
        if (reverse != made.end())
          return -reverse->second;
        const int tag = centre == no_centre ? gmsh::model::geo::addLine(from + 1, to + 1)
                                            : gmsh::model::geo::addCircleArc(from + 1, centre + 1, to + 1);
        made[key] = tag;
        return tag;
      }

      const double size;
      unsigned int n_corners = 0;
      std::vector<Point<2>> points;
      std::map<std::array<unsigned int, 3>, int> made;
      std::map<unsigned int, std::vector<int>> groups;
    };

    GmshFile mesh_of_gmsh(const std::map<unsigned int, std::vector<int>> &groups, const std::string &file)
    {
      const GmshNodes all_nodes = gmsh_nodes();
      GmshFile mesh;
      for (const Point<3> &p : all_nodes.places)
        mesh.nodes.emplace_back(p[0], p[1], 0.);
      constexpr int quadrilateral = 3;
      for (const auto &[group, surfaces] : groups)
        for (const int surface : surfaces)
        {
          std::vector<int> types;
          std::vector<std::vector<std::size_t>> elements, nodes;
          gmsh::model::mesh::getElements(types, elements, nodes, 2, surface);
          for (std::size_t t = 0; t < types.size(); ++t)
          {
            if (types[t] != quadrilateral)
              throw InputError("gmsh left " + std::to_string(elements[t].size()) +
                               " triangles in the section " + file +
                               ": give another Section cell size, or a Section mesh of your own.");
            for (std::size_t k = 0; k < nodes[t].size(); k += 4)
            {
              std::array<unsigned int, 4> corners;
              for (unsigned int v = 0; v < 4; ++v)
                corners[v] = all_nodes.number.at(nodes[t][k + v]);
              mesh.quadrilaterals.push_back(corners);
              mesh.cells.groups.push_back(group == 0 ? std::vector<unsigned int>()
                                                     : std::vector<unsigned int>{group});
            }
          }
        }
      return mesh;
    }

    /// The other half of a section about a = 0, with the nodes there in common.
    void add_mirror_image(GmshFile &mesh)
    {
      std::vector<unsigned int> image;
      const std::size_t n_nodes = mesh.nodes.size(), n_cells = mesh.quadrilaterals.size();
      for (std::size_t k = 0; k < n_nodes; ++k)
      {
        const bool on_axis = std::abs(mesh.nodes[k][0]) < section_resolution;
        image.push_back(on_axis ? k : mesh.nodes.size());
        if (!on_axis)
          mesh.nodes.emplace_back(-mesh.nodes[k][0], mesh.nodes[k][1], 0.);
      }
      for (std::size_t k = 0; k < n_cells; ++k)
      {
        const auto q = mesh.quadrilaterals[k];
        mesh.quadrilaterals.push_back({{image[q[3]], image[q[2]], image[q[1]], image[q[0]]}});
        mesh.cells.groups.push_back(mesh.cells.groups[k]);
      }
    }
  } // namespace

  std::vector<OutlineLoop> closed_loops(const SectionOutline &outline, const bool mirrored,
                                        const std::string &file)
  {
    std::vector<OutlineLoop> loops;
    const auto on_axis = [&](const Point<2> &p) { return mirrored && std::abs(p[0]) < section_resolution; };
    for (unsigned int k = 0; k < outline.rows.size(); ++k)
    {
      const SectionOutline::Row &row = outline.rows[k];
      for (const Point<2> &p : {row.start, row.end})
      {
        if (!mirrored && !(p[1] > section_resolution))
          throw InputError("The section outline " + file + " crosses its axle: it reaches a radius of " +
                           number_text(1e3 * p[1]) + " mm; give one half of the section, all radii above 0.");
        if (mirrored && p[0] < -section_resolution)
          throw InputError("The section outline " + file + " reaches over its line of symmetry, to a = " +
                           number_text(1e3 * p[0]) + " mm; give its right half, all of it at a >= 0.");
      }
      const bool begins = loops.empty() || loops.back().rows.empty();
      // the edge along the line of symmetry is drawn here, whether the file has it or not
      if (begins && on_axis(row.start) && on_axis(row.end))
        continue;
      if (begins)
        loops.push_back({row.region, {}});
      std::vector<SectionOutline::Row> &rows = loops.back().rows;
      const unsigned int number = k + 1;
      const auto open = [&](const Point<2> &end, const std::string &next)
      {
        return InputError(
            "The section outline " + file + region_text(loops.back()) + " is not closed: its curve number " +
            std::to_string(number - (next.empty() ? 0 : 1)) + " ends at " + in_mm(end) +
            (next.empty() ? ", the first begins at " + in_mm(rows.front().start) : next) +
            "; let every curve begin where the one before ends, and the last end where the first begins.");
      };
      if (!rows.empty() && !are_one(rows.back().end, row.start))
        throw open(rows.back().end, ", the next begins at " + in_mm(row.start));
      rows.push_back(row);
      bool closed = are_one(row.end, rows.front().start);
      if (!closed && on_axis(row.end) && on_axis(rows.front().start))
      {
        SectionOutline::Row axis;
        axis.start = row.end;
        axis.end = rows.front().start;
        axis.region = row.region;
        rows.push_back(axis);
        closed = true;
      }
      if (closed)
        loops.push_back({});
      else if (number == outline.rows.size() || outline.rows[number].region != row.region)
        throw open(row.end, "");
    }
    if (loops.empty())
      throw InputError(
          "The section outline " + file +
          " encloses nothing: all of its curves lie on its line of symmetry, a = 0; draw its right half, "
          "at a >= 0.");
    loops.pop_back();
    check_crossings(loops, file);
    return loops;
  }

  GmshFile mesh_outline(const SectionOutline &outline, const double size, const bool mirrored,
                        const std::string &file)
  {
    const std::vector<OutlineLoop> loops = closed_loops(outline, mirrored, file);
    std::map<std::string, unsigned int> groups;
    for (const OutlineLoop &loop : loops)
      if (!loop.region.empty())
        groups.emplace(loop.region, groups.size() + 1);
    GmshFile mesh;
    try
    {
      const Gmsh gmsh;
      Drawing drawing(loops, size);
      for (const OutlineLoop &loop : loops)
        drawing.add(loop, loop.region.empty() ? 0 : groups.at(loop.region));
      gmsh::model::geo::synchronize();
      const std::map<std::string, double> options = {
          {"Mesh.Algorithm", 6},    {"Mesh.RecombineAll", 1},   {"Mesh.RecombinationAlgorithm", 3},
          {"Mesh.Smoothing", 20},   {"Mesh.MeshSizeMax", size}, {"Mesh.MeshSizeFromPoints", 1},
          {"Mesh.ElementOrder", 1}, {"Mesh.MaxNumThreads2D", 1}};
      for (const auto &[name, value] : options)
        gmsh::option::setNumber(name, value);
      gmsh::model::mesh::generate(2);
      mesh = mesh_of_gmsh(drawing.surfaces(), file);
    }
    catch (const std::string &error)
    {
      throw InputError("gmsh cannot mesh the section outline " + file + ": " + error +
                       "; give another Section cell size, or a Section mesh of your own.");
    }
    if (mesh.quadrilaterals.empty())
      throw InputError("gmsh made no cells of the section outline " + file +
                       ": give a smaller Section cell size.");
    for (const auto &[name, group] : groups)
      mesh.cells.names[group] = name;
    if (mirrored)
      add_mirror_image(mesh);
    return mesh;
  }
} // namespace vibrocontact
