#pragma once

#include <vibrocontact/base/entries_read.h>
#include <vibrocontact/base/parameter_file.h>
#include <vibrocontact/base/parameter_group.h>
#include <vibrocontact/scene/body_mesh.h>
#include <vibrocontact/scene/body_use.h>
#include <vibrocontact/scene/contact_frame.h>
#include <vibrocontact/scene/contact_grid.h>
#include <vibrocontact/scene/elastic_model.h>
#include <vibrocontact/scene/flat_face.h>
#include <vibrocontact/scene/glued_parts.h>
#include <vibrocontact/scene/section.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <nlohmann/json_fwd.hpp>

#include <complex>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  class ElementBody;
  class Log;
  class PointBody;
  class RevolvedBody;
  class SolidBody;
  struct BodyInContact;
  struct ContactTrace;
  struct BodyParameters;
  struct IdentifiedParameters;
  struct RailParameters;
  struct ReducedBody;
  struct RevolvedMesh;
  struct SecondOrderSystem;
  struct WheelDamper;

  /// Where contacts of a body may lie.
  enum class ContactPlaces
  {
    /// anywhere on its surface, in any direction
    anywhere,
    /// in the usual directions, anywhere
    any_origin,
    /// at any height of the axis z
    along_axis,
    /// at its own place alone
    own
  };

  /// What the section of a type of body describes: its entries and what they say of the body. All that is asked of a body's
  /// type is asked here, so that no other place needs to know which type it is (doc/extending.md).
  class BodyDescription : public ParameterGroup
  {
  public:
    void check(const std::string &) const override {}
    /// Entries that decide what other sections there are. @param section of this type in the file
    virtual void read_ahead(const ParameterFile &, const std::string &) {}
    /// The entries of its section that matter to a use. @return false: all of them do, without saying which
    virtual bool add_entries(EntriesRead &, const std::string &, const BodyUse &) const { return false; }
    /// Lines of the scene's summary.
    virtual void print(Log &) const {}
    /// what a picture needs of a body without a surface of its own, names with units
    virtual nlohmann::ordered_json sizes() const;

    // What it is made of; null: of something else.
    /// hexahedra, with loads and fields
    virtual const SolidBody *solid() const { return nullptr; }
    /// elements of its section, one problem for each number of waves around its axle
    virtual const RevolvedBody *revolved() const { return nullptr; }
    /// elements assembled by itself
    virtual const ElementBody *elements() const { return nullptr; }
    /// modes or poles in closed form, known at its own contact points alone
    virtual const PointBody *at_points() const { return nullptr; }
    /// a rail without ends on equal supports, known by its receptance
    virtual const RailParameters *periodic_rail() const { return nullptr; }
    /// data or poles from a file, known at their points alone
    virtual const IdentifiedParameters *measured() const { return nullptr; }
    virtual bool is_rigid() const { return false; }
    /// has a section Material; others bring their own stiffness
    virtual bool has_material() const { return true; }
    /// has a mesh whose groups of cells may have materials of their own
    virtual bool has_groups() const { return false; }
    /// of the loads it knows gravity alone; a solid knows them all
    virtual bool takes_gravity() const { return false; }

    // How it moves.
    /// known between its own contact points alone, by modes or by poles
    virtual bool has_own_points() const { return at_points() || measured(); }
    /// turns with the speed of rolling, so that its material flows through its contact points
    virtual bool rolls() const { return false; }
    /// all of its flexibility has mass: a force moves its contact points by their inertia alone
    virtual bool has_rigid_points() const { return false; }
    /// its contact points may have a flexibility without mass
    virtual bool may_yield() const { return true; }
    /// the contact node of its elements has no mass
    virtual bool has_massless_points() const { return false; }
    /// moves along z alone
    virtual bool moves_along_z_only() const { return false; }
    /// a force into a stop moves it along the stop too
    virtual bool is_driven_along_stop() const { return true; }
    /// nothing moves along y
    virtual bool is_plane() const { return false; }
    /// may turn steadily about an axis as a whole, seen in axes that turn with it: has a section Rotation
    virtual bool may_turn() const { return false; }
    /// its material does not flow through the contact: slides, but does not roll
    virtual bool stays_in_place() const { return false; }
    /// takes energy beside its material
    virtual bool has_loss() const { return false; }
    /// stands under a load beside section Loads
    virtual bool has_weight() const { return false; }
    /// What is empty so that the body is free, and what to do; both empty: it is held. @param name of the body
    virtual std::pair<std::string, std::string> missing_support(const std::string &) const { return {}; }
    /// What of it knows no stiffness under the stress of its loads, and what to do; empty: nothing. @param name of the body
    virtual std::string in_the_way_of_prestress(const std::string &) const { return {}; }

    // Where it is touched.
    /// Its own contact points, if it brings some; nothing: those of the grid of section Contact.
    /// @param cell size of the cell of a point that has none of its own [m]
    virtual std::optional<ContactGrid> contact_points(double) const { return {}; }
    /// its only point has no cell of its own but one of Contact/Grid spacing
    virtual bool takes_cell() const { return false; }
    /// own contact points on a road: place, forward; height of the undeformed surface [m]; empty: those of its grid
    virtual std::vector<double> places() const { return {}; }
    virtual std::vector<double> heights() const { return {}; }
    /// of the tread under a contact point, radially or along the road; not contained in what elements() assembles [m/N]
    virtual double tread_compliance(bool) const { return 0; }
    virtual ContactPlaces contact_places() const { return ContactPlaces::own; }
    /// its contact points look down: it is the body above
    virtual bool touches_downwards_only() const { return false; }
    /// what would let it look up, as the end of a sentence: " or ..."
    virtual std::string way_to_look_up() const { return ""; }
    /// lies below its contact: it is the body below
    virtual bool lies_below() const { return false; }
    /// its points lie on a half-space, which has no inertia and couples within one grid only
    virtual bool lies_on_half_space() const { return false; }
    /// a half-space may take the place of its own flexibility under a contact
    virtual bool may_stand_for_half_space() const { return true; }
    /// Example of Periodic/Contact points if these have to be given; empty: the contact grid does as well.
    virtual std::string example_of_points() const { return ""; }
    /// Its contact surface, or the entry that chooses it. @param name of the body
    virtual std::string contact_surface(const std::string &name) const
    {
      return "The contact surface of body " + name;
    }
    /// What would turn it to the other side. @param name of the body
    /// @param above whether it is the upper body
    virtual std::string way_to_turn(const std::string &, bool) const
    {
      return "this body belongs to the other place";
    }
    /// of the undeformed surface along x and y, a convex one being positive [1/m]
    virtual std::pair<double, double> curvatures() const { return {0, 0}; }
    /// The rectangle that is all of its contact surface; nothing: another surface. Reads the file.
    virtual std::optional<FlatFace> flat_face(double) const { return {}; }
    /// as body 1 it lies where Contact/Lateral position says
    virtual bool follows_lateral_position() const { return false; }

    // Bodies of revolution.
    /// what damps it besides its materials (reduction/damped_wheel.h); null: it knows none
    virtual const std::vector<WheelDamper> *wheel_dampers() const { return nullptr; }
    /// turns about an axle: its modes have labels and Eq. 23's damping
    virtual bool is_wheel() const { return false; }
    /// The outline of a wheel's section. Reads the file.
    virtual std::optional<SectionOutline> wheel_section() const { return {}; }
    /// size of a wheel over the size that its section is drawn in
    virtual double size_over_section() const { return 1; }

    /// It writes its mesh to a file: the mesh has to be made.
    virtual bool writes_mesh() const { return false; }
    virtual void write_no_mesh() {}

    /// Mean motion of a piece of its surface, rows normal, x, y (fe/trace_row.h), of bodies without mesh; empty: there is
    /// no surface. @param name of the body; x, y: place, length along x [m]
    virtual std::vector<std::vector<std::pair<dealii::types::global_dof_index, double>>>
    surface_rows(const std::string &, double, double, double) const
    {
      return {};
    }
    /// The reduced body on a road: rows of all points upward, with friction then those forward. What a tread adds is in
    /// it. @param speed, upstream as PointBody::between_points()
    virtual BodyInContact on_road(const ReducedBody &reduced, bool with_friction, double speed = 0,
                                  const std::vector<double> &upstream = {}) const;
  };

  /// A body of finite elements that assembles itself, such as a type that a program adds.
  class ElementBody : public BodyDescription
  {
  public:
    const ElementBody *elements() const override { return this; }
    /// Mass, stiffness and, on the grid, the contact trace (fe/second_order_system.h). Collective.
    /// @param above whether it is body 1, above the plane of contact
    /// @param grid of the contact points; null if no analysis has contact
    virtual std::unique_ptr<SecondOrderSystem> assemble(const BodyParameters &body, bool above,
                                                        const ContactGrid *grid,
                                                        MPI_Comm communicator) const = 0;
    /// It is assembled from files, which may be wrong: before anything is run.
    virtual bool is_assembled_first() const { return false; }
    /// Moves the contact of the assembled body away from its usual place, where contacts may lie along its axis
    /// (ContactPlaces::along_axis). @param trace in its usual place @param z height [m]
    virtual void move_contact(const SecondOrderSystem &, ContactTrace &, double) const
    {
      AssertThrow(false, dealii::ExcMessage("This body does not say how its contact moves along its axis."));
    }
  };

  /// A body of hexahedra.
  class SolidBody : public BodyDescription
  {
  public:
    struct MeshRequest
    {
      /// of the body, for messages
      std::string name;
      /// of the contact on a wheel or, beside its offset, a block [m]
      double lateral_position;
      /// of its contacts
      const std::vector<ContactPlace> &places;
      /// that covers them; null: a body without contact
      const ContactGrid *grid;
      /// groups of cells with a material each; empty: one material
      std::vector<std::string> materials;
      MPI_Comm communicator;
      /// where meshes of CAD parts are kept between runs; empty: nowhere
      std::string mesh_folder = {};
    };

    const SolidBody *solid() const override { return this; }
    ContactPlaces contact_places() const override { return ContactPlaces::anywhere; }
    /// @throws InputError
    virtual BodyMesh<3> make_mesh(const MeshRequest &request) const = 0;
    /// Boundaries that are held or on springs. @param mesh of make_mesh()
    virtual void hold(ElasticModel<3> &model, const BodyMesh<3> &mesh) const = 0;
    virtual unsigned int mesh_degree() const { return 2; }
    /// Groups of its parts whose meshes do not match. @param name of the body
    virtual std::vector<GluedPair> glued(const std::string &) const { return {}; }
  };

  /// A body of revolution whose motions are solved wave by wave around its axle.
  class RevolvedBody
  {
  public:
    virtual ~RevolvedBody() = default;
    /// @throws InputError
    virtual RevolvedMesh make_section(const SolidBody::MeshRequest &request) const = 0;
  };

  /// A body that is known at its own contact points, by modes or poles in closed form.
  class PointBody
  {
  public:
    virtual ~PointBody() = default;
    /// Rows of all points upward, with friction then those forward. @param speed of rolling [m/s]
    /// @param upstream differences along which material flows through the points, of what has no closed form
    /// (contact/creep.h); empty: nothing asks for gradients
    virtual BodyInContact between_points(bool with_friction, double speed,
                                         const std::vector<double> &upstream = {}) const = 0;
    /// Names of these rows.
    virtual std::vector<std::string> row_names(bool with_friction) const = 0;
    /// Receptances of these rows as a sum over circumferential orders: @p highest of them by inversion, those above static
    /// or left out. Empty: it has no orders. [m/N] over omega [rad/s]
    /// @param highest, residual, with_friction, speed
    virtual std::function<dealii::LAPACKFullMatrix<std::complex<double>>(double)>
    sum_of_orders(unsigned int, bool, bool, double) const
    {
      return {};
    }
    /// Circumferential orders that it keeps, and whether those above answer statically.
    struct Orders
    {
      unsigned int highest;
      bool residual;
    };
    /// nothing: it has none
    virtual std::optional<Orders> orders() const { return {}; }
  };
} // namespace vibrocontact
