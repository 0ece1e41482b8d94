#include <vibrocontact/fe/face_overlap.h>

#include <deal.II/base/polynomials_barycentric.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/tensor_product_polynomials.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    using Polygon = std::vector<Point<2>>;

    /// The polynomials of each kind of face, made once.
    const ScalarPolynomialsBase<2> &polynomials(const bool triangle, const unsigned int degree)
    {
      static std::map<std::pair<bool, unsigned int>, std::unique_ptr<ScalarPolynomialsBase<2>>> all;
      std::unique_ptr<ScalarPolynomialsBase<2>> &one = all[{triangle, degree}];
      if (!one && triangle)
        one = std::make_unique<BarycentricPolynomials<2>>(BarycentricPolynomials<2>::get_fe_p_basis(degree));
      if (!one)
        one = std::make_unique<TensorProductPolynomials<2>>(
            Polynomials::generate_complete_Lagrange_basis(QGaussLobatto<1>(degree + 1).get_points()));
      return *one;
    }

    void evaluate(const SurfaceFace &face, const Point<2> &s, std::vector<double> &values,
                  std::vector<Tensor<1, 2>> &gradients)
    {
      std::vector<Tensor<2, 2>> none2;
      std::vector<Tensor<3, 2>> none3;
      std::vector<Tensor<4, 2>> none4;
      polynomials(face.triangle, face.degree).evaluate(s, values, gradients, none2, none3, none4);
    }

    double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /// The plane in the middle of a face.
    struct Plane
    {
      explicit Plane(const SurfaceFace &face) : origin(face.place(face.middle()))
      {
        normal = face.area_vector(face.middle());
        normal /= normal.norm();
        axes[0] = face.tangents(face.middle())[0];
        axes[0] /= axes[0].norm();
        axes[1] = cross_product_3d(normal, axes[0]);
      }
      Point<2> projected(const Point<3> &x) const { return {(x - origin) * axes[0], (x - origin) * axes[1]}; }

      Point<3> origin;
      Tensor<1, 3> normal;
      std::array<Tensor<1, 3>, 2> axes;
    };

    /// A face in the coordinates of a plane.
    class ProjectedFace
    {
    public:
      ProjectedFace(const SurfaceFace &face, const Plane &plane) : face(face)
      {
        for (const Point<3> &node : face.nodes)
          nodes.push_back(plane.projected(node));
        size = face.diameter();
      }

      /// Convex pieces, counter-clockwise: the face itself if its edges are straight, else four.
      std::vector<Polygon> pieces() const
      {
        std::vector<Polygon> result;
        const unsigned int n = is_straight() ? 1 : 2;
        const double h = 1. / n;
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
          {
            const double x = i * h, y = j * h;
            if (!face.triangle)
              result.push_back({{x, y}, {x + h, y}, {x + h, y + h}, {x, y + h}});
            else if (i + j < n)
              result.push_back({{x, y}, {x + h, y}, {x, y + h}});
            else
              result.push_back({{x, y}, {x, y - h}, {x - h, y}});
          }
        if (face.triangle && n == 2)
          result.back() = {{h, 0}, {h, h}, {0, h}};
        for (Polygon &piece : result)
        {
          for (Point<2> &p : piece)
            p = place(p);
          if (area(piece) < 0)
            std::reverse(piece.begin(), piece.end());
        }
        return result;
      }

      /// The face's coordinates of a place in the plane, by Newton's method from those of the last place.
      Point<2> coordinates(const Point<2> &y)
      {
        Point<2> s = last;
        for (unsigned int step = 0; step < 30; ++step)
        {
          Point<2> x;
          Tensor<2, 2> jacobian;
          evaluate(face, s, values, gradients);
          for (unsigned int k = 0; k < nodes.size(); ++k)
          {
            x += values[k] * nodes[k];
            jacobian += outer_product(nodes[k], gradients[k]);
          }
          const Tensor<1, 2> change = invert(jacobian) * (y - x);
          s += change;
          if (change.norm() < 1e-14 || (step > 0 && affine))
            break;
        }
        last = s;
        return s;
      }

      static double area(const Polygon &polygon)
      {
        double sum = 0;
        for (unsigned int k = 2; k < polygon.size(); ++k)
          sum += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]) / 2;
        return sum;
      }

    private:
      Point<2> place(const Point<2> &s) const
      {
        Point<2> x;
        evaluate(face, s, values, gradients);
        for (unsigned int k = 0; k < nodes.size(); ++k)
          x += values[k] * nodes[k];
        return x;
      }

      bool is_straight() const
      {
        if (face.degree == 1)
          return true;
        const std::vector<Point<2>> ends =
            face.triangle ? Polygon{{0, 0}, {1, 0}, {0, 1}} : Polygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        for (unsigned int k = 0; k < ends.size(); ++k)
        {
          const Point<2> &a = ends[k], &b = ends[(k + 1) % ends.size()];
          const Point<2> from = place(a), to = place(b), middle = place(Point<2>((a + b) / 2.));
          if (std::abs(cross(middle - from, to - from)) > 1e-10 * size * size)
            return false;
        }
        return true;
      }

      const SurfaceFace &face;
      Polygon nodes;
      double size;
      const bool affine = face.is_affine();
      Point<2> last = face.middle();
      mutable std::vector<double> values = std::vector<double>(face.nodes.size());
      mutable std::vector<Tensor<1, 2>> gradients = std::vector<Tensor<1, 2>>(face.nodes.size());
    };

    /// What of a convex polygon lies left of the line from a to b.
    Polygon left_of(const Polygon &polygon, const Point<2> &a, const Point<2> &b)
    {
      Polygon result;
      for (unsigned int k = 0; k < polygon.size(); ++k)
      {
        const Point<2> &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
        const double here = cross(b - a, from - a), there = cross(b - a, to - a);
        if (here >= 0)
          result.push_back(from);
        if ((here > 0 && there < 0) || (here < 0 && there > 0))
          result.push_back(from + here / (here - there) * (to - from));
      }
      return result;
    }

    Polygon common(Polygon polygon, const Polygon &other)
    {
      for (unsigned int k = 0; k < other.size() && polygon.size() > 2; ++k)
        polygon = left_of(polygon, other[k], other[(k + 1) % other.size()]);
      return polygon;
    }

    /// Points of a rule over a triangle for products of shape functions of two faces; distorted quadrilaterals need more, their
    /// shape functions being rational in space.
    unsigned int n_points(const SurfaceFace &first, const SurfaceFace &second)
    {
      constexpr unsigned int for_distortion = 5;
      const unsigned int degree = std::max(first.degree, second.degree);
      return 2 * degree + 1 + (first.is_affine() && second.is_affine() ? 0 : for_distortion);
    }
  } // namespace

  std::vector<Point<2>> SurfaceFace::unit_nodes(const bool triangle, const unsigned int degree)
  {
    if (triangle && degree == 1)
      return {{0, 0}, {1, 0}, {0, 1}};
    if (triangle)
      return {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
    std::vector<Point<2>> result;
    const std::vector<Point<1>> points = QGaussLobatto<1>(degree + 1).get_points();
    for (const Point<1> &y : points)
      for (const Point<1> &x : points)
        result.emplace_back(x[0], y[0]);
    return result;
  }

  void SurfaceFace::shapes(const Point<2> &s, std::vector<double> &values) const
  {
    std::vector<Tensor<1, 2>> gradients;
    values.resize(nodes.size());
    evaluate(*this, s, values, gradients);
  }

  Point<3> SurfaceFace::place(const Point<2> &s) const
  {
    std::vector<double> values;
    shapes(s, values);
    Point<3> x;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      x += values[k] * nodes[k];
    return x;
  }

  std::array<Tensor<1, 3>, 2> SurfaceFace::tangents(const Point<2> &s) const
  {
    std::vector<double> values(nodes.size());
    std::vector<Tensor<1, 2>> gradients(nodes.size());
    evaluate(*this, s, values, gradients);
    std::array<Tensor<1, 3>, 2> result;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (unsigned int d = 0; d < 2; ++d)
        result[d] += gradients[k][d] * nodes[k];
    return result;
  }

  Tensor<1, 3> SurfaceFace::area_vector(const Point<2> &s) const
  {
    const auto along = tangents(s);
    return side * cross_product_3d(along[0], along[1]);
  }

  Point<2> SurfaceFace::middle() const
  {
    return triangle ? Point<2>(1. / 3, 1. / 3) : Point<2>(0.5, 0.5);
  }

  std::vector<Point<3>> SurfaceFace::corners() const
  {
    if (triangle)
      return {nodes[0], nodes[1], nodes[2]};
    const unsigned int n = degree + 1;
    return {nodes[0], nodes[n - 1], nodes[n * n - 1], nodes[n * (n - 1)]};
  }

  double SurfaceFace::diameter() const
  {
    double largest = 0;
    const std::vector<Point<3>> all = corners();
    for (const Point<3> &a : all)
      for (const Point<3> &b : all)
        largest = std::max(largest, a.distance(b));
    return largest;
  }

  bool SurfaceFace::is_affine() const
  {
    const std::vector<Point<2>> unit = unit_nodes(triangle, degree);
    const std::vector<Point<3>> ends = corners();
    const double size = diameter();
    for (unsigned int k = 0; k < nodes.size(); ++k)
    {
      const Point<3> x = ends[0] + unit[k][0] * (ends[1] - ends[0]) + unit[k][1] * (ends.back() - ends[0]);
      if (x.distance(nodes[k]) > 1e-12 * size)
        return false;
    }
    return true;
  }

  double SurfaceFace::area() const
  {
    const QGauss<2> square(degree + 3);
    const QDuffy triangle_rule(degree + 3, 1.);
    const Quadrature<2> &rule = triangle ? static_cast<const Quadrature<2> &>(triangle_rule) : square;
    double sum = 0;
    for (unsigned int q = 0; q < rule.size(); ++q)
      sum += rule.weight(q) * area_vector(rule.point(q)).norm();
    return sum;
  }

  FaceOverlap overlap_of(const SurfaceFace &first, const SurfaceFace &second)
  {
    const Plane plane(first);
    ProjectedFace one(first, plane), other(second, plane);
    FaceOverlap result;
    const double smallest = 1e-13 * std::pow(first.diameter(), 2);
    const QDuffy rule(n_points(first, second), 1.);
    const std::vector<Polygon> others = other.pieces();
    for (const Polygon &mine : one.pieces())
      for (const Polygon &its : others)
      {
        const Polygon shared = common(mine, its);
        for (unsigned int k = 2; k < shared.size(); ++k)
        {
          const Tensor<1, 2> a = shared[k - 1] - shared[0], b = shared[k] - shared[0];
          if (!(cross(a, b) > smallest))
            continue;
          for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const Point<2> y = shared[0] + rule.point(q)[0] * a + rule.point(q)[1] * b;
            SharedPoint point;
            point.on_first = one.coordinates(y);
            point.on_second = other.coordinates(y);
            const Tensor<1, 3> normal = first.area_vector(point.on_first);
            // the area of the face, not of its projection
            point.weight = rule.weight(q) * cross(a, b) * normal.norm() / (normal * plane.normal);
            const double gap = (second.place(point.on_second) - first.place(point.on_first)) * plane.normal;
            if (std::abs(gap) > std::abs(result.gap))
              result.gap = gap;
            result.points.push_back(point);
          }
        }
      }
    return result;
  }
} // namespace vibrocontact
