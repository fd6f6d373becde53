//! What a validated shader binds: names and numbers for the host.

use naga::{AddressSpace, GlobalVariable, Module, TypeInner};

/// A resource that the entry point really uses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name of the global variable.
    pub name: String,
    /// `@binding` in group 0.
    pub binding: u32,
}

/// Byte layout of the uniform struct of snippet parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ParameterLayout {
    /// Size of the struct in bytes; 0 when the shader has no parameters.
    pub size: u32,
    /// (field, byte offset).
    pub offsets: Vec<(String, u32)>,
}

/// The host's view of a shader.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Interface {
    /// Used resources, by binding.
    pub bindings: Vec<Field>,
    /// Layout of `params`.
    pub parameters: ParameterLayout,
}

impl Interface {
    /// Reads the interface of the first entry point.
    pub(crate) fn of(module: &Module, info: &naga::valid::ModuleInfo) -> Self {
        let mut interface = Interface::default();
        if module.entry_points.is_empty() {
            return interface;
        }
        let entry = info.get_entry_point(0);
        for (handle, variable) in module.global_variables.iter() {
            if entry[handle].is_empty() {
                continue;
            }
            let (Some(name), Some(binding)) = (&variable.name, &variable.binding) else { continue };
            interface.bindings.push(Field { name: name.clone(), binding: binding.binding });
            if name == "params" {
                interface.parameters = layout(module, variable);
            }
        }
        interface.bindings.sort_by_key(|field| field.binding);
        interface
    }
}

fn layout(module: &Module, variable: &GlobalVariable) -> ParameterLayout {
    match &module.types[variable.ty].inner {
        TypeInner::Struct { members, span } if variable.space == AddressSpace::Uniform => ParameterLayout {
            size: *span,
            offsets: members.iter().map(|member| (member.name.clone().unwrap_or_default(), member.offset)).collect(),
        },
        _ => ParameterLayout::default(),
    }
}
