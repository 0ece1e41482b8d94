#pragma once

#include <vibrocontact/scene/body_mesh.h>

#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/reference_cell.h>

#include <memory>
#include <vector>

namespace vibrocontact
{
  /// What depends on the shape of a body's cells - element, quadrature, geometry, faces - in one place: hexahedra
  /// (quadrilaterals), tetrahedra and prisms.
  /// @throws dealii::ExceptionBase for a degree that the shape does not have (tetrahedra and prisms: 1 and 2)
  template <int dim>
  std::unique_ptr<dealii::FiniteElement<dim>> scalar_element(const dealii::ReferenceCell &cell,
                                                             unsigned int degree);

  /// Where the nodes of a scalar element lie; deal.II does not say it for prisms of degree 2.
  template <int dim>
  std::vector<dealii::Point<dim>> scalar_node_points(const dealii::FiniteElement<dim> &scalar);

  /// Exact for polynomials of degree 2 n - 1, n up to 4 on tetrahedra and prisms.
  template <int dim>
  dealii::Quadrature<dim> cell_quadrature(const dealii::ReferenceCell &cell, unsigned int n);

  /// Points of the rule in each direction, of a body's matrices: hexahedra and prisms with curved edges of their own need a
  /// point more for constant strains.
  template <int dim>
  unsigned int n_gauss_points(const BodyMesh<dim> &mesh, const dealii::FiniteElement<dim> &scalar)
  {
    return scalar.degree + (!mesh.mid_nodes.empty() && !scalar.reference_cell().is_simplex() ? 2 : 1);
  }

  /// Geometry of the cells: polynomials through the nodes that the manifolds or the file's mid-nodes give.
  template <int dim>
  std::unique_ptr<const dealii::Mapping<dim>> make_mapping(const BodyMesh<dim> &mesh);

  /// Corners of face @p f in the reference cell, those of hexahedra in the order of the cell's other axes.
  template <int dim>
  std::vector<dealii::Point<dim>> face_corners(const dealii::ReferenceCell &cell, unsigned int f);

  /// The point of face @p f with the coordinates @p s: of the unit square, or of the unit triangle.
  template <int dim>
  dealii::Point<dim> on_face(const dealii::ReferenceCell &cell, unsigned int f,
                             const dealii::Point<dim - 1> &s);

  /// Whether a point of the reference cell lies on its face @p f.
  template <int dim>
  bool lies_on_face(const dealii::ReferenceCell &cell, unsigned int f, const dealii::Point<dim> &p);

  /// Shape functions, area elements and normals on the faces of tetrahedra and prisms, where deal.II's own (FEFaceValues) know
  /// neither prisms nor every geometry: the cell's, on the points of a face.
  template <int dim>
  class FaceValues
  {
  public:
    /// @param scalar element of the body
    /// @param n of the rule, as in cell_quadrature() @param with_gradients shape_grad() is asked
    FaceValues(const dealii::Mapping<dim> &mapping, const dealii::FiniteElement<dim> &scalar, unsigned int n,
               bool with_gradients = false);
    void reinit(const typename dealii::Triangulation<dim>::active_cell_iterator &cell, unsigned int f);
    unsigned int n_points() const { return areas.size(); }
    /// of node k in point q [-]
    double shape_value(const unsigned int k, const unsigned int q) const
    {
      return current->shape_value(k, q);
    }
    /// [1/m]
    dealii::Tensor<1, dim> shape_grad(const unsigned int k, const unsigned int q) const
    {
      return current->shape_grad(k, q);
    }
    /// [m^2]
    double JxW(const unsigned int q) const { return areas[q]; }
    /// outwards, of unit length
    const dealii::Tensor<1, dim> &normal_vector(const unsigned int q) const { return normals[q]; }

  private:
    struct Rule
    {
      std::vector<double> weights;
      std::array<dealii::Tensor<1, dim>, dim - 1> along;
      /// 1 if these turn to the outer side, else -1
      double side;
      std::unique_ptr<dealii::FEValues<dim>> values;
    };
    std::vector<Rule> rules;
    const dealii::FEValues<dim> *current = nullptr;
    std::vector<double> areas;
    std::vector<dealii::Tensor<1, dim>> normals;
  };
} // namespace vibrocontact
