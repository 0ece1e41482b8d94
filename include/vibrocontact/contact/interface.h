#pragma once

#include <vibrocontact/contact/contact_problem.h>
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/contact/laws/contact_laws.h>
#include <vibrocontact/scene/flat_face.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// `subsection Contact`, or that of one of several contacts: where two bodies may touch, and by which laws.
  struct ContactParameters
  {
    /// of its section; name in the entry Contacts, empty: the only one, of section Contact, which joins the two bodies
    /// of the scene in the usual frame
    std::string section = "Contact", name;
    /// the two that it joins: the one above, the one below
    std::vector<std::string> bodies;
    /// nominal point in the coordinates of the first body and of the second (empty: the same) [m], direction from the
    /// second to the first [-]
    std::vector<double> origin = {0, 0, 0}, origin_below, normal = {0, 0, 1};
    /// added to the undeformed gap [m]
    double gap = 0;
    /// creepages beside those of the scene, in the contact's own frame
    Creepage own_creepage;
    /// mu [-]; where friction depends on the slip speed its value at high speed
    double friction = 0.3;
    /// spacing of the contact points along x and y [m]
    double spacing = 1e-3;
    /// the grid covers at least [-half_length, half_length] x [-half_width, half_width] [m]
    double half_length = 10e-3, half_width = 8e-3;
    /// 2-D contact of long cylinders: one row of cells of this length along y; 0: a grid in both directions
    /// [m]
    double strip_length = 0;
    /// shift of the grid against the nominal contact point, in spacings [-]
    double offset_x = 0, offset_y = 0;
    /// lateral position of the nominal contact point in the section of body 1 [m]
    double lateral_position = 0;
    std::string creep_scheme = "second-order upwind";
    /// how tractions are spread over the bodies' elements: "lumped" or "consistent"
    std::string quadrature = "lumped";
    /// what stands under the contact of a solid body beside its modes: "finite elements" (its residual
    /// flexibility) or "half-space" (Boussinesq and Cerruti's of its material in place of it)
    std::string local_flexibility = "finite elements";
    /// false: normal forces move no point tangentially by the local flexibility, nor tangential ones normally
    bool coupling = true;
    std::string normal_law = "signorini";
    /// empty: falling friction where a static friction ratio other than 1 is given, otherwise Coulomb's
    std::string friction_law;
    /// the other entries that laws are made of
    LawValues law_values;
    /// that the entries choose from; never null
    std::shared_ptr<const ContactLaws> laws;

    /// no entries: flat faces that the bodies touch with, and whether the rolling speed is zero (found once the
    /// bodies are known)
    std::vector<FlatFace> flat_faces;
    bool at_rest = false;

    /// law_values are the defaults of the laws
    ContactParameters() : ContactParameters(std::make_shared<const ContactLaws>()) {}
    explicit ContactParameters(std::shared_ptr<const ContactLaws> laws);
    /// Bodies and place are entries of a contact with a name.
    void declare_parameters(dealii::ParameterHandler &prm);
    ContactFrame frame() const;
    /// In the coordinates of the second body.
    ContactFrame frame_below() const;
    /// Reads the curves of the laws that are named here or by another section, before any law is made, and takes `friction`
    /// from a law that the entry does not scale. Collective.
    /// @param further normal law that an analysis takes in place of `normal_law`, or empty
    /// @throws InputError with entry, file and line, or for a curve that makes no law
    void read_curves(const std::string &further);
    /// Grid with a point on the nominal contact point (offset zero); without what lies beyond a flat face.
    ContactGrid grid() const;
    /// Sides of a grid that a flat face ends with.
    SurfaceEnds ends(const ContactGrid &grid) const;
    /// The normal law that the entries describe, or another one of their values.
    std::shared_ptr<const NormalLaw> law() const { return law(normal_law); }
    std::shared_ptr<const NormalLaw> law(const std::string &name) const;
    /// Row of the table that the entries of friction mean.
    const FrictionLawEntry &friction_entry() const;
    /// Whether that law is scaled by the entry Friction coefficient.
    bool takes_coefficient() const;
    /// @param coefficient in place of the entry's, as in a sweep [-]
    std::shared_ptr<const FrictionLaw> law_of_friction(double coefficient) const;
    std::shared_ptr<const FrictionLaw> law_of_friction() const { return law_of_friction(friction); }
    bool has_consistent_quadrature() const { return quadrature == "consistent"; }
    bool half_space_flexibility() const { return local_flexibility == "half-space"; }
    /// Whether the local flexibility is another than the elements', so that modes have to carry the rest.
    bool replaces_flexibility() const { return half_space_flexibility() || !coupling; }

  private:
    void declare_place(dealii::ParameterHandler &prm);
  };

  /// Sections of all contacts of a scene, in the order of the entry Contacts.
  struct ContactSections
  {
    std::vector<ContactParameters> all;

    ContactSections() : ContactSections(ContactParameters()) {}
    ContactSections(ContactParameters one) : all{std::move(one)} {}
    /// the only one, of a scene that has one
    ContactParameters &first() { return all.front(); }
    const ContactParameters &first() const { return all.front(); }
    /// With another friction coefficient in all of them.
    ContactSections with_friction(double coefficient) const;
  };

  /// The laws of all points.
  PointLaws<NormalLaw> normal_law_of_points(const ContactSections &sections, const PlacedContacts &contacts);
  /// The same with one law by its name in place of Contact/Normal law.
  PointLaws<NormalLaw> normal_law_of_points(const ContactSections &sections, const PlacedContacts &contacts,
                                            const std::string &name);
  PointLaws<FrictionLaw> friction_law_of_points(const ContactSections &sections,
                                                const PlacedContacts &contacts);

  /// Geometry of the contacts of a scene.
  struct ContactInterface
  {
    PlacedContacts contacts;
    /// undeformed gap, surface of the first body above that of the second; n [m]
    std::vector<double> gap;
    /// jump (first body minus second) of the contact displacements under loads on the bodies; 3 n [m], empty
    /// without loads
    DenseVector load_jump;
  };

  /// y = A R of two half-spaces in steady rolling (what CONTACT models).
  std::shared_ptr<const ContactOperator> rolling_operator(const ContactGrid &grid, const HalfSpacePair &pair,
                                                          const CreepScheme &scheme, double speed);

  /// y = A R of any two bodies in steady rolling: compliance is the sum of both bodies' contact compliances,
  /// 3 n square [m/N]. A_n = (P_c K^-1 P_c^T)_n, A_t = V d/dx (P_c K^-1 P_c^T)_t (doc/theory.md, "One contact
  /// problem for every analysis").
  /// @param gradient what d/dx is beyond the differences between points (of material that flows through a body known by poles); 3 n square [1/N] or empty
  std::shared_ptr<const ContactOperator> rolling_operator(const PlacedContacts &contacts,
                                                          DenseMatrix compliance, const CreepScheme &scheme,
                                                          double speed,
                                                          const DenseMatrix &gradient = DenseMatrix());

  /// The contact problem of steady rolling; neither force nor approach is set yet.
  ContactProblem rolling_problem(std::shared_ptr<const ContactOperator> A, const ContactInterface &interface,
                                 const CreepScheme &scheme, const Creepage &creepage,
                                 const ContactSections &sections);

  /// Refuses a contact that reaches a side of its grid, beyond which it could go on: one row or column has to
  /// stay open, two columns on the upstream side of what rolls (the upwind difference starts from points
  /// without traction). Sides where the surface itself ends may be reached, upstream at rest only.
  /// @param speed rolling speed [m/s]
  /// @throws InputError naming the side and the entry to enlarge
  void check_contact_in_grid(const PlacedContacts &contacts, const ContactSections &sections, double speed,
                             const std::vector<ContactStatus> &status);

  /// The points on such sides, ascending; of what rolls the last column upstream alone, for what knows its material further upstream
  /// (RingParameters::angles_beyond()).
  std::vector<unsigned int> points_at_open_sides(const PlacedContacts &contacts,
                                                 const ContactSections &sections);
} // namespace vibrocontact
