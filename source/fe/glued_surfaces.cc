#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/fe/glued_surfaces.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Dof = MortarMatrices::Dof;
    using Matrices = FullMatrix<double>;

    /// a gap beyond this share of the larger face is refused; facets of a circle by sixteen are 0.05 of a side off
    constexpr double largest_gap = 0.05;
    /// faces covered to less are refused
    constexpr double least_covered = 0.5;
    /// faces that see each other: cosine between one's normal and the other's from behind
    constexpr double facing = 0.5;

    BoundingBox<3> box_of(const SurfaceFace &face)
    {
      return BoundingBox<3>(face.nodes);
    }

    std::string text_of(const Point<3> &p)
    {
      std::ostringstream text;
      text << "(" << p << ") m";
      return text.str();
    }

    /// Faces of one kind of fault.
    struct FaultyFaces
    {
      unsigned int n = 0;
      Point<3> place;
      double value = 0;
      void add(const SurfaceFace &face, const double measure)
      {
        if (n++ > 0)
          return;
        place = face.place(face.middle());
        value = measure;
      }
    };

    /// The ends of the edge in whose middle node @p i of a quadratic face lies; none: it is no such node.
    std::vector<unsigned int> ends_of(const SurfaceFace &face, const unsigned int i)
    {
      if (face.triangle && i >= 3)
        return {i - 3, (i - 2) % 3};
      if (face.triangle || i % 2 == 0)
        return {};
      const bool along_x = i == 1 || i == 7;
      return along_x ? std::vector<unsigned int>{i - 1, i + 1} : std::vector<unsigned int>{i - 3, i + 3};
    }

    /// Shape functions whose dual ones exist: those of a group with quadratic triangles transformed (glue_faces()), those of
    /// quadrilaterals beside them (prisms) as well, since they share edges.
    void dual_shapes(const SurfaceFace &face, const bool transformed, const Point<2> &s,
                     std::vector<double> &values)
    {
      face.shapes(s, values);
      if (!transformed)
        return;
      for (unsigned int i = 0; i < values.size(); ++i)
      {
        const std::vector<unsigned int> ends = ends_of(face, i);
        if (ends.empty())
          continue;
        for (const unsigned int c : ends)
          values[c] += MortarMatrices::alpha * values[i];
        values[i] *= 1 - 2 * MortarMatrices::alpha;
      }
    }

    /// Where a follower's face lies on leaders.
    struct Covering
    {
      std::vector<std::pair<unsigned int, FaceOverlap>> parts;
      double covered = 0;
    };

    class Coverings
    {
    public:
      Coverings(const std::vector<FaceOfDofs> &followers, const std::vector<FaceOfDofs> &leaders,
                MortarMatrices &result)
          : touched(leaders.size(), false)
      {
        std::vector<std::pair<BoundingBox<3>, unsigned int>> boxes;
        for (unsigned int k = 0; k < leaders.size(); ++k)
          boxes.emplace_back(box_of(leaders[k].face), k);
        const auto tree = pack_rtree(boxes);
        double area = 0, covered = 0;
        for (const FaceOfDofs &one : followers)
        {
          const SurfaceFace &face = one.face;
          const double size = face.diameter();
          Tensor<1, 3> normal = face.area_vector(face.middle());
          normal /= normal.norm();
          BoundingBox<3> near = box_of(face);
          near.extend(size);
          std::vector<std::pair<BoundingBox<3>, unsigned int>> found;
          tree.query(boost::geometry::index::intersects(near), std::back_inserter(found));
          std::vector<unsigned int> candidates;
          for (const auto &entry : found)
            candidates.push_back(entry.second);
          std::sort(candidates.begin(), candidates.end());

          Covering covering;
          double off = 1e300;
          for (const unsigned int k : candidates)
          {
            const SurfaceFace &other = leaders[k].face;
            const Tensor<1, 3> opposite = other.area_vector(other.middle());
            if (normal * opposite > -facing * opposite.norm())
              continue;
            FaceOverlap overlap = overlap_of(face, other);
            if (overlap.points.empty())
              continue;
            if (std::abs(overlap.gap) > largest_gap * std::max(size, other.diameter()))
            {
              off = std::min(off, std::abs(overlap.gap));
              continue;
            }
            result.gap = std::max(result.gap, std::abs(overlap.gap));
            for (const SharedPoint &point : overlap.points)
              covering.covered += point.weight;
            touched[k] = true;
            covering.parts.emplace_back(k, std::move(overlap));
          }
          const double own = face.area();
          if (covering.covered < least_covered * own)
          {
            if (off < 1e299)
              distant.add(face, off);
            else
              beside.add(face, covering.covered / own);
          }
          area += own;
          covered += covering.covered;
          all.push_back(std::move(covering));
        }
        result.uncovered = std::max(0., 1 - covered / area);
      }

      std::vector<Covering> all;
      std::vector<bool> touched;
      FaultyFaces distant, beside;
    };

    /// The first face of a patch of the leader, joined by nodes, on which nothing lies; nothing: there is none.
    const FaceOfDofs *bare_patch(const std::vector<FaceOfDofs> &leaders, const std::vector<bool> &touched)
    {
      std::map<Dof, unsigned int> of_node;
      std::vector<unsigned int> patch(leaders.size());
      std::iota(patch.begin(), patch.end(), 0u);
      const auto root = [&](unsigned int k)
      {
        while (patch[k] != k)
          k = patch[k] = patch[patch[k]];
        return k;
      };
      for (unsigned int k = 0; k < leaders.size(); ++k)
        for (const auto &dofs : leaders[k].dofs)
          patch[root(k)] = root(of_node.emplace(dofs[0], k).first->second);
      std::set<unsigned int> covered;
      for (unsigned int k = 0; k < leaders.size(); ++k)
        if (touched[k])
          covered.insert(root(k));
      for (unsigned int k = 0; k < leaders.size(); ++k)
        if (covered.count(root(k)) == 0)
          return &leaders[k];
      return nullptr;
    }

    /// Adds what one face of the follower gives to D and M.
    void integrate(const FaceOfDofs &one, const bool transformed, const Covering &covering,
                   const std::vector<FaceOfDofs> &leaders, MortarMatrices &result)
    {
      const unsigned int n = one.dofs.size();
      // both of the same points: a face's dual functions are exactly dual in the sums, whatever the rule leaves out
      Matrices mass(n, n), dual(n, n);
      std::vector<double> areas(n), values, others;
      for (const auto &part : covering.parts)
        for (const SharedPoint &point : part.second.points)
        {
          dual_shapes(one.face, transformed, point.on_first, values);
          for (unsigned int i = 0; i < n; ++i)
          {
            areas[i] += point.weight * values[i];
            for (unsigned int j = 0; j < n; ++j)
              mass(i, j) += point.weight * values[i] * values[j];
          }
        }
      mass.gauss_jordan();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          dual(i, j) = areas[i] * mass(i, j);
      for (unsigned int i = 0; i < n; ++i)
        result.followers[one.dofs[i][0]].area += areas[i];
      for (const auto &[k, overlap] : covering.parts)
      {
        const FaceOfDofs &leader = leaders[k];
        Matrices products(n, leader.dofs.size()), rows(n, leader.dofs.size());
        for (const SharedPoint &point : overlap.points)
        {
          dual_shapes(one.face, transformed, point.on_first, values);
          leader.face.shapes(point.on_second, others);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int m = 0; m < others.size(); ++m)
              products(i, m) += point.weight * values[i] * others[m];
        }
        dual.mmult(rows, products);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int m = 0; m < leader.dofs.size(); ++m)
            result.followers[one.dofs[i][0]].leaders[leader.dofs[m][0]] += rows(i, m);
      }
    }

    void describe_nodes(const std::vector<FaceOfDofs> &followers, const bool transformed,
                        const std::vector<FaceOfDofs> &leaders, MortarMatrices &result)
    {
      std::map<Dof, std::set<Dof>> neighbours;
      for (const FaceOfDofs &one : followers)
        for (unsigned int i = 0; i < one.dofs.size(); ++i)
        {
          MortarMatrices::Node &node = result.followers[one.dofs[i][0]];
          node.place = one.face.nodes[i];
          node.dofs = one.dofs[i];
          if (transformed && node.corners.empty())
            for (const unsigned int c : ends_of(one.face, i))
              node.corners.push_back(one.dofs[c][0]);
          for (const auto &other : one.dofs)
            if (other != one.dofs[i])
              neighbours[one.dofs[i][0]].insert(other[0]);
        }
      for (const auto &[node, set] : neighbours)
        result.followers[node].neighbours.assign(set.begin(), set.end());
      for (const FaceOfDofs &one : leaders)
        for (unsigned int i = 0; i < one.dofs.size(); ++i)
          result.leaders[one.dofs[i][0]] = {one.face.nodes[i], one.dofs[i]};
    }
  } // namespace

  MortarMatrices mortar_matrices(const std::vector<FaceOfDofs> &followers,
                                 const std::vector<FaceOfDofs> &leaders, const std::string &entry,
                                 const std::string &follower_name, const std::string &leader_name)
  {
    MortarMatrices result;
    const Coverings coverings(followers, leaders, result);
    const auto complain = [&](const FaultyFaces &fault, const std::string &what, const std::string &advice)
    {
      throw InputError(entry + ": " + std::to_string(fault.n) + " of the " +
                       std::to_string(followers.size()) + " faces of \"" + follower_name + "\" " + what +
                       ", the first at " + text_of(fault.place) + advice);
    };
    if (coverings.distant.n > 0)
      complain(coverings.distant,
               "are off \"" + leader_name + "\" by more than " + number_text(largest_gap) +
                   " of a face's size",
               " by " + number_text(coverings.distant.value) +
                   " m: glued faces touch; move the parts together, or mesh what lies between.");
    if (coverings.beside.n > 0)
      complain(coverings.beside, "lie on \"" + leader_name + "\" with less than half of their area",
               " with " + number_text(100 * coverings.beside.value) +
                   " %: the group before the colon lies within the other one; exchange the two, or take the "
                   "faces beside it out of the group.");
    if (const FaceOfDofs *const bare = bare_patch(leaders, coverings.touched))
      throw InputError(entry + ": no face of \"" + follower_name + "\" lies on the part of \"" + leader_name +
                       "\" at " + text_of(bare->face.place(bare->face.middle())) +
                       ", whose body would be loose there: take that part out of the group, or glue "
                       "something to it.");
    const bool transformed =
        std::any_of(followers.begin(), followers.end(),
                    [](const FaceOfDofs &one) { return one.face.triangle && one.face.degree == 2; });
    describe_nodes(followers, transformed, leaders, result);
    for (unsigned int k = 0; k < followers.size(); ++k)
      integrate(followers[k], transformed, coverings.all[k], leaders, result);
    return result;
  }
} // namespace vibrocontact
