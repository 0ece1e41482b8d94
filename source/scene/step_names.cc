#include <vibrocontact/scene/step_names.h>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TDF_ChildIterator.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS_Shape.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ShapeTool.hxx>

namespace vibrocontact
{
  namespace
  {
    void add_names(const TDF_Label &label, std::vector<StepName> &names)
    {
      TopoDS_Shape shape;
      Handle(TDataStd_Name) name;
      if (XCAFDoc_ShapeTool::GetShape(label, shape) && shape.ShapeType() == TopAbs_FACE &&
          label.FindAttribute(TDataStd_Name::GetID(), name))
      {
        GProp_GProps properties;
        BRepGProp::SurfaceProperties(shape, properties);
        const gp_Pnt centre = properties.CentreOfMass();
        const TCollection_ExtendedString &wide = name->Get();
        std::string text(wide.LengthOfCString() + 1, '\0');
        Standard_PCharacter to = text.data();
        wide.ToUTF8CString(to);
        text.resize(wide.LengthOfCString());
        names.push_back({text, properties.Mass(), {centre.X(), centre.Y(), centre.Z()}});
      }
      for (TDF_ChildIterator child(label); child.More(); child.Next())
        add_names(child.Value(), names);
    }
  } // namespace

  std::vector<StepName> step_names(const std::string &file)
  {
    // the reader makes these options, with their defaults
    STEPCAFControl_Controller::Init();
    Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
    Interface_Static::SetCVal("xstep.cascade.unit", "M");
    Handle(TDocStd_Document) document;
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
    STEPCAFControl_Reader reader;
    reader.SetNameMode(true);
    std::vector<StepName> names;
    if (reader.ReadFile(file.c_str()) == IFSelect_RetDone && reader.Transfer(document))
      add_names(document->Main(), names);
    return names;
  }
} // namespace vibrocontact
