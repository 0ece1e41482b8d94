#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/scene/blade.h>
#include <vibrocontact/scene/mesh_quality.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vibrocontact
{
  using namespace dealii;

  namespace
  {
    /// cells end at z = length (i / n)^grading: short ones at the root, where stresses are singular
    constexpr double root_grading = 2;

    /// Chart: the straight blade.
    class TwistManifold : public ChartManifold<3, 3, 3>
    {
    public:
      /// @param first angle at z = 0 [rad], @param rate [rad/m]
      TwistManifold(const double first, const double rate) : first(first), rate(rate) {}
      std::unique_ptr<Manifold<3, 3>> clone() const override
      {
        return std::make_unique<TwistManifold>(first, rate);
      }
      Point<3> pull_back(const Point<3> &p) const override { return turned(p, -1); }
      Point<3> push_forward(const Point<3> &chart) const override { return turned(chart, 1); }

    private:
      Point<3> turned(const Point<3> &p, const double sense) const
      {
        const double angle = sense * (first + rate * p[2]), c = std::cos(angle), s = std::sin(angle);
        return Point<3>(c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]);
      }
      const double first, rate;
    };
  } // namespace

  void BladeParameters::declare_parameters(ParameterHandler &prm)
  {
    using Patterns::Double;
    using Patterns::Integer;
    prm.add_parameter("Length", length, "Size along z, root to tip. Units: m.", Double(0));
    prm.add_parameter("Chord", chord, "Width of the section. Units: m.", Double(0));
    prm.add_parameter("Thickness", thickness, "Thickness of the section. Units: m.", Double(0));
    prm.add_parameter("Root angle", root_angle, "Angle from x to the chord at the root. Units: deg.",
                      Double(-360, 360));
    prm.add_parameter("Tip angle", tip_angle, "Angle from x to the chord at the tip. Units: deg.",
                      Double(-360, 360));
    prm.add_parameter("Length divisions", length_divisions, "Cells from root to tip. Units: none.",
                      Integer(1, 1000));
    prm.add_parameter("Chord divisions", chord_divisions, "Cells along the chord. Units: none.",
                      Integer(1, 1000));
    prm.add_parameter("Thickness divisions", thickness_divisions, "Cells through the thickness. Units: none.",
                      Integer(1, 100));
    prm.add_parameter("Element degree", element_degree, "Degree of the displacements. Units: none.",
                      Integer(1, 4));
  }

  void BladeParameters::check(const std::string &section) const
  {
    for (const auto &[entry, size] :
         {std::make_pair("Length", length), {"Chord", chord}, {"Thickness", thickness}})
      if (!(size > 1e-6) || size > 100)
        throw InputError(section + "/" + entry + " is " + number_text(size) +
                         " m: give a size between 1e-6 and 100 m.");
    const double turn =
        std::abs(tip_angle - root_angle) * (1 - std::pow(1 - 1. / length_divisions, root_grading));
    if (turn > 30)
      throw InputError(section + "/Tip angle turns the last of the " + std::to_string(length_divisions) +
                       " cells along the blade by " + number_text(turn) +
                       " deg, more than the 30 that its elements follow: give more Length divisions.");
  }

  BodyMesh<3> make_blade(const BladeParameters &parameters, const std::string &name,
                         const MPI_Comm communicator)
  {
    check_number_of_cells<3>(double(parameters.chord_divisions) * parameters.thickness_divisions *
                                 parameters.length_divisions,
                             parameters.element_degree, name, "choose fewer divisions");
    const double half_chord = parameters.chord / 2, half_thickness = parameters.thickness / 2;
    Triangulation<3> straight;
    GridGenerator::subdivided_hyper_rectangle(
        straight, {parameters.chord_divisions, parameters.thickness_divisions, parameters.length_divisions},
        Point<3>(-half_chord, -half_thickness, 0), Point<3>(half_chord, half_thickness, parameters.length),
        true);
    const double first = parameters.root_angle * numbers::PI / 180;
    const TwistManifold twist(first, (parameters.tip_angle * numbers::PI / 180 - first) / parameters.length);
    auto [vertices, cells, faces] = GridTools::get_coarse_mesh_description(straight);
    for (Point<3> &vertex : vertices)
    {
      vertex[2] = parameters.length * std::pow(vertex[2] / parameters.length, root_grading);
      vertex = twist.push_forward(vertex);
    }

    BodyMesh<3> mesh;
    mesh.name = name;
    mesh.geometry_degree = std::max(2u, parameters.element_degree);
    mesh.triangulation = std::make_unique<parallel::distributed::Triangulation<3>>(
        communicator, Triangulation<3>::limit_level_difference_at_vertices);
    mesh.triangulation->create_triangulation(vertices, cells, faces);
    mesh.triangulation->set_all_manifold_ids(0);
    mesh.triangulation->set_manifold(0, twist);
    mesh.boundaries = {{"leading", 0}, {"trailing", 1}, {"pressure", 2},
                       {"suction", 3}, {"root", 4},     {"tip", 5}};
    mesh.contact_boundaries = {mesh.boundaries.at("tip")};
    return mesh;
  }

  bool BladeParameters::add_entries(EntriesRead &entries, const std::string &section, const BodyUse &) const
  {
    entries.add(section, "Length, Chord, Thickness, Root angle, Tip angle, Length divisions, "
                         "Chord divisions, Thickness divisions, Element degree");
    return true;
  }

  BodyMesh<3> BladeParameters::make_mesh(const MeshRequest &request) const
  {
    return make_blade(*this, request.name, request.communicator);
  }

  void BladeParameters::hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const
  {
    model.held = {mesh.boundary_id("root")};
  }
} // namespace vibrocontact
