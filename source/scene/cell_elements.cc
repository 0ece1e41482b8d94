#include <vibrocontact/scene/cell_elements.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_wedge_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_fe_field.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using namespace dealii;

  template <int dim>
  std::unique_ptr<FiniteElement<dim>> scalar_element(const ReferenceCell &cell, const unsigned int degree)
  {
    if (cell.is_hyper_cube())
      return std::make_unique<FE_Q<dim>>(degree);
    AssertThrow(degree == 1 || degree == 2, ExcMessage("Tetrahedra and prisms have the degree 1 or 2."));
    if (cell.is_simplex())
      return std::make_unique<FE_SimplexP<dim>>(degree);
    if constexpr (dim == 3)
      if (cell == ReferenceCells::Wedge)
        return std::make_unique<FE_WedgeP<dim>>(degree);
    AssertThrow(false, ExcMessage("Cells of this shape have no element."));
    return {};
  }

  template <int dim>
  std::vector<Point<dim>> scalar_node_points(const FiniteElement<dim> &scalar)
  {
    if (scalar.has_support_points())
      return scalar.get_unit_support_points();
    // prisms: the nodes of a triangle at three heights, each where its shape function is one
    std::vector<Point<dim>> points(scalar.n_dofs_per_cell());
    const FE_SimplexP<2> triangle(scalar.degree);
    for (const Point<2> &p : triangle.get_unit_support_points())
      for (unsigned int h = 0; h <= scalar.degree; ++h)
      {
        Point<dim> candidate;
        candidate[0] = p[0];
        candidate[1] = p[1];
        candidate[dim - 1] = double(h) / scalar.degree;
        for (unsigned int k = 0; k < points.size(); ++k)
          if (std::abs(scalar.shape_value(k, candidate) - 1) < 1e-12)
            points[k] = candidate;
      }
    return points;
  }

  template <int dim>
  Quadrature<dim> cell_quadrature(const ReferenceCell &cell, const unsigned int n)
  {
    return cell.template get_gauss_type_quadrature<dim>(n);
  }

  namespace
  {
    /// The nodes of a mesh of second order around a vertex, edge, face or cell.
    template <int dim>
    typename BodyMesh<dim>::Around around(std::vector<unsigned int> vertices)
    {
      std::sort(vertices.begin(), vertices.end());
      typename BodyMesh<dim>::Around result;
      result.fill(BodyMesh<dim>::no_vertex);
      std::copy(vertices.begin(), vertices.end(), result.begin());
      return result;
    }

    /// Place of the node of a coarse cell that lies at @p unit of the reference cell: in the middle of the vertices that
    /// are nearest to it.
    Point<3> coarse_node(const BodyMesh<3> &mesh, const Triangulation<3>::cell_iterator &cell,
                         const Point<3> &unit)
    {
      // of prisms the middle of a face is as far from four vertices, of an edge from two
      const ReferenceCell shape = cell->reference_cell();
      std::vector<double> share(cell->n_vertices());
      double largest = 0;
      for (const unsigned int v : cell->vertex_indices())
      {
        share[v] = shape.template d_linear_shape_function<3>(unit, v);
        largest = std::max(largest, share[v]);
      }
      std::vector<unsigned int> vertices;
      unsigned int last = 0;
      for (const unsigned int v : cell->vertex_indices())
        if (share[v] > 0.5 * largest)
        {
          vertices.push_back(cell->vertex_index(v));
          last = v;
        }
      return vertices.size() == 1 ? cell->vertex(last) : mesh.mid_nodes.at(around<3>(vertices));
    }

    /// Quadratic cells of tetrahedra or prisms, none of which is refined.
    struct QuadraticNodes
    {
      explicit QuadraticNodes(const BodyMesh<3> &mesh)
          : element(*scalar_element<3>(mesh.reference_cell(), 2), 3), dof_handler(*mesh.triangulation)
      {
        dof_handler.distribute_dofs(element);
        places.reinit(dof_handler.n_dofs());
        const std::vector<Point<3>> points = scalar_node_points<3>(element.base_element(0));
        std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
        for (const auto &cell : dof_handler.active_cell_iterators())
          if (!cell->is_artificial())
          {
            cell->get_dof_indices(dofs);
            for (unsigned int node = 0; node < points.size(); ++node)
            {
              const Point<3> place = coarse_node(mesh, cell, points[node]);
              for (unsigned int d = 0; d < 3; ++d)
                places(dofs[element.component_to_system_index(d, node)]) = place[d];
            }
          }
      }

      const FESystem<3> element;
      DoFHandler<3> dof_handler;
      Vector<double> places;
    };

    class QuadraticMapping : private QuadraticNodes, public MappingFEField<3, 3, Vector<double>>
    {
    public:
      explicit QuadraticMapping(const BodyMesh<3> &mesh)
          : QuadraticNodes(mesh), MappingFEField<3, 3, Vector<double>>(QuadraticNodes::dof_handler,
                                                                       QuadraticNodes::places)
      {
      }
    };

    /// Quadratic hexahedra; those of a refined cell lie on its polynomials.
    std::unique_ptr<const Mapping<3>> quadratic_hexahedra(const BodyMesh<3> &mesh)
    {
      const FE_Q<3> element(2);
      const std::vector<Point<3>> &points = element.get_unit_support_points();
      std::vector<std::vector<Point<3>>> coarse(mesh.triangulation->n_cells(0));
      for (const auto &cell : mesh.triangulation->cell_iterators_on_level(0))
        for (const Point<3> &p : points)
          coarse[cell->index()].push_back(coarse_node(mesh, cell, p));
      auto mapping = std::make_unique<MappingQCache<3>>(2);
      mapping->initialize(*mesh.triangulation,
                          [&](const Triangulation<3>::cell_iterator &cell)
                          {
                            std::vector<Point<3>> unit = points;
                            Triangulation<3>::cell_iterator ancestor = cell;
                            for (; ancestor->level() > 0; ancestor = ancestor->parent())
                            {
                              unsigned int child = 0;
                              while (ancestor->parent()->child(child) != ancestor)
                                ++child;
                              for (Point<3> &p : unit)
                                p = GeometryInfo<3>::child_to_cell_coordinates(p, child);
                            }
                            const std::vector<Point<3>> &nodes = coarse[ancestor->index()];
                            std::vector<Point<3>> places;
                            for (const Point<3> &p : unit)
                            {
                              Point<3> place;
                              for (unsigned int k = 0; k < nodes.size(); ++k)
                                place += element.shape_value(k, p) * nodes[k];
                              places.push_back(place);
                            }
                            return places;
                          });
      return mapping;
    }
  } // namespace

  template <int dim>
  std::unique_ptr<const Mapping<dim>> make_mapping(const BodyMesh<dim> &mesh)
  {
    if constexpr (dim == 3)
      if (!mesh.mid_nodes.empty())
      {
        if (mesh.is_hypercube())
          return quadratic_hexahedra(mesh);
        return std::make_unique<QuadraticMapping>(mesh);
      }
    if (!mesh.is_hypercube())
      return std::make_unique<MappingFE<dim>>(*scalar_element<dim>(mesh.reference_cell(), 1));
    auto mapping = std::make_unique<MappingQCache<dim>>(mesh.geometry_degree);
    mapping->initialize(MappingQ<dim>(mesh.geometry_degree), *mesh.triangulation);
    return mapping;
  }

  template <int dim>
  std::vector<Point<dim>> face_corners(const ReferenceCell &cell, const unsigned int f)
  {
    std::vector<Point<dim>> corners;
    if (cell.is_hyper_cube())
    {
      for (unsigned int v = 0; v < (1u << (dim - 1)); ++v)
      {
        Point<dim> p;
        p[f / 2] = f % 2;
        for (unsigned int d = 0, k = 0; d < dim; ++d)
          if (d != f / 2)
            p[d] = (v >> k++) & 1u;
        corners.push_back(p);
      }
      return corners;
    }
    const unsigned int n = cell.face_reference_cell(f).n_vertices();
    for (unsigned int v = 0; v < n; ++v)
      corners.push_back(cell.template vertex<dim>(cell.face_to_cell_vertices(f, v, 1)));
    return corners;
  }

  template <int dim>
  Point<dim> on_face(const ReferenceCell &cell, const unsigned int f, const Point<dim - 1> &s)
  {
    const std::vector<Point<dim>> corners = face_corners<dim>(cell, f);
    Point<dim> p = corners[0];
    for (unsigned int d = 0; d < dim - 1; ++d)
      p += s[d] * (corners[1 + d] - corners[0]);
    return p;
  }

  template <int dim>
  bool lies_on_face(const ReferenceCell &cell, const unsigned int f, const Point<dim> &p)
  {
    const std::vector<Point<dim>> corners = face_corners<dim>(cell, f);
    Tensor<1, dim> normal;
    if constexpr (dim == 3)
      normal = cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]);
    else
      normal = cross_product_2d(corners[1] - corners[0]);
    return std::abs(normal * (p - corners[0])) < 1e-10;
  }

  namespace
  {
    /// across the tangents of a face; its length is the area between them
    template <int dim>
    Tensor<1, dim> across(const std::array<Tensor<1, dim>, dim - 1> &tangents)
    {
      if constexpr (dim == 3)
        return cross_product_3d(tangents[0], tangents[1]);
      else
        return cross_product_2d(tangents[0]);
    }
  } // namespace

  template <int dim>
  FaceValues<dim>::FaceValues(const Mapping<dim> &mapping, const FiniteElement<dim> &scalar,
                              const unsigned int n, const bool with_gradients)
  {
    const ReferenceCell cell = scalar.reference_cell();
    for (unsigned int f = 0; f < cell.n_faces(); ++f)
    {
      const Quadrature<dim - 1> face = cell_quadrature<dim - 1>(cell.face_reference_cell(f), n);
      std::vector<Point<dim>> points;
      for (const Point<dim - 1> &s : face.get_points())
        points.push_back(on_face<dim>(cell, f, s));
      const std::vector<Point<dim>> corners = face_corners<dim>(cell, f);
      Rule rule;
      rule.weights = face.get_weights();
      for (unsigned int d = 0; d < dim - 1; ++d)
        rule.along[d] = corners[1 + d] - corners[0];
      rule.side = across<dim>(rule.along) * (corners[0] - cell.template barycenter<dim>()) > 0 ? 1 : -1;
      rule.values = std::make_unique<FEValues<dim>>(mapping, scalar, Quadrature<dim>(points),
                                                    update_values | update_jacobians |
                                                        (with_gradients ? update_gradients : update_default));
      rules.push_back(std::move(rule));
    }
  }

  template <int dim>
  void FaceValues<dim>::reinit(const typename Triangulation<dim>::active_cell_iterator &cell,
                               const unsigned int f)
  {
    Rule &rule = rules[f];
    rule.values->reinit(cell);
    current = rule.values.get();
    areas.clear();
    normals.clear();
    for (unsigned int q = 0; q < rule.weights.size(); ++q)
    {
      std::array<Tensor<1, dim>, dim - 1> tangents;
      for (unsigned int d = 0; d < dim - 1; ++d)
        tangents[d] = apply_transformation(rule.values->jacobian(q), rule.along[d]);
      const Tensor<1, dim> normal = across<dim>(tangents);
      areas.push_back(rule.weights[q] * normal.norm());
      normals.push_back(rule.side / normal.norm() * normal);
    }
  }

#define VIBROCONTACT_INSTANTIATE(dim)                                                                        \
  template std::unique_ptr<FiniteElement<dim>> scalar_element(const ReferenceCell &, unsigned int);          \
  template std::vector<Point<dim>> scalar_node_points(const FiniteElement<dim> &);                           \
  template Quadrature<dim> cell_quadrature(const ReferenceCell &, unsigned int);                             \
  template std::unique_ptr<const Mapping<dim>> make_mapping(const BodyMesh<dim> &);                          \
  template std::vector<Point<dim>> face_corners(const ReferenceCell &, unsigned int);                        \
  template Point<dim> on_face(const ReferenceCell &, unsigned int, const Point<dim - 1> &);                  \
  template bool lies_on_face(const ReferenceCell &, unsigned int, const Point<dim> &);                       \
  template class FaceValues<dim>;
  VIBROCONTACT_INSTANTIATE(2)
  VIBROCONTACT_INSTANTIATE(3)
#undef VIBROCONTACT_INSTANTIATE
} // namespace vibrocontact
