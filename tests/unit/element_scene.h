#pragma once

#include <vibrocontact/coupled_bodies/contact_pair.h>
#include <vibrocontact/fe/bar_elements.h>
#include <vibrocontact/fe/layer_elements.h>
#include <vibrocontact/reduction/all_modes.h>
#include <vibrocontact/reduction/reduction_parts.h>
#include <vibrocontact/run/unreduced_pair.h>

#include <memory>

namespace vibrocontact
{
  /// A body of elements on a rigid plane, by some of its modes and by all of them.
  struct ElementScene
  {
    BodyParameters body, plane;
    std::unique_ptr<SecondOrderSystem> system;
    Modes modes;
    ReducedBody reduced, unreduced;
    /// of the reduced body
    ContactPair pair;
    /// all modes of the elements
    ContactPair all;
  };

  inline std::unique_ptr<ElementScene> element_scene(std::unique_ptr<ElementScene> scene,
                                                     const ContactGrid &grid, const unsigned int n_modes)
  {
    scene->plane = BodyParameters("plane", "rigid");
    Flexibility flexibility(*scene->system);
    ModeParameters modes;
    modes.count = n_modes;
    const ModalReduction modal = reduce_modally(*scene->system, flexibility, modes, {}, &scene->modes);
    scene->reduced = combine(reduce_statically(*scene->system, flexibility), &modal);
    scene->unreduced =
        with_all_modes(scene->reduced, *scene->system, all_modes(*scene->system, scene->modes));
    scene->pair = contact_pair({&scene->body, &scene->reduced}, {&scene->plane, nullptr}, {}, grid);
    scene->all = contact_pair({&scene->body, &scene->unreduced}, {&scene->plane, nullptr}, {}, grid);
    return scene;
  }

  inline std::unique_ptr<ElementScene>
  layer_scene(const LayerParameters &parameters, const ElasticMaterial &material, const unsigned int n_modes)
  {
    auto scene = std::make_unique<ElementScene>();
    scene->body = body_of("layer", "layer", parameters);
    const ContactGrid grid = parameters.grid();
    scene->system = assemble_layer(parameters, material, "layer", &grid, MPI_COMM_WORLD);
    return element_scene(std::move(scene), grid, n_modes);
  }

  /// E 2 GPa, nu 0.3, rho 2000
  inline ElasticMaterial soft()
  {
    ElasticMaterial material;
    material.young_modulus = 2e9;
    material.poisson_ratio = 0.3;
    material.density = 2000;
    return material;
  }

  /// A free bar of the bouncing-bar example's size and material: 10 m, E 900, rho 1, section 1. @param bar its elements
  inline std::unique_ptr<ElementScene> bar_scene(BarParameters bar, const unsigned int n_modes,
                                                 const double gravity = 0)
  {
    auto scene = std::make_unique<ElementScene>();
    bar.length = 10;
    bar.section = 1;
    bar.far_end = "free";
    scene->body = body_of("bar", "bar", bar);
    ElasticMaterial material;
    material.young_modulus = 900;
    material.poisson_ratio = 0;
    material.density = 1;
    ContactGrid grid;
    grid.n_x = grid.n_y = 1;
    grid.spacing_x = grid.spacing_y = 1;
    scene->system = assemble_bar(bar, material, "bar", true, &grid, MPI_COMM_WORLD, gravity);
    return element_scene(std::move(scene), grid, n_modes);
  }

  inline std::unique_ptr<ElementScene> bar_scene(const unsigned int divisions, const unsigned int degree,
                                                 const unsigned int n_modes)
  {
    BarParameters bar;
    bar.divisions = divisions;
    bar.degree = degree;
    return bar_scene(bar, n_modes);
  }
} // namespace vibrocontact
