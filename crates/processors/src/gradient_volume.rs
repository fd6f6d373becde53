//! Gradient volume: precomputes gradients and stores them beside the values.

use std::sync::Arc;

use rayloom_network::{
    Choice, Declaration, Facts, InportDecl, Job, OutportDecl, Outputs, PortType, ProcessError, PropertyDecl,
};
use rayloom_volume::{Operator, VolumeRole, gradient_volume};

use crate::volume_source::outputs_of;
use crate::{Context, Data, JobData, Precision};

/// Ports, properties and help.
pub fn declaration() -> Declaration {
    let volume = InportDecl::new("volume", "Volume", &[PortType::Volume])
        .help("A volume of values.")
        .condition("a volume of values, not one of gradients", |facts| {
            matches!(facts, Facts::Volume { role: VolumeRole::Values, .. })
        });
    let result = OutportDecl::new("gradients", "Gradients", PortType::Volume)
        .help("Four channels: the gradient along the voxel axes and the value, so that one sample fetches both.");
    let operators = vec![
        Choice::new("central", "Central differences", "Half the difference of the two neighbours along each axis."),
        Choice::new(
            "sobel",
            "Sobel",
            "Central differences smoothed across the axis over 27 voxels: less noise, less detail.",
        ),
    ];
    let storages = vec![
        Choice::new("32-bit", "32 bits", "32-bit floats: 16 bytes a voxel."),
        Choice::new("16-bit", "16 bits", "Half floats: 8 bytes a voxel."),
        Choice::new("8-bit", "8 bits", "127 steps to either side of zero: 4 bytes a voxel, directions a little off."),
    ];
    Declaration::new("gradient_volume", "Gradient volume", "Volume")
        .help(
            "Computes the gradient at every voxel once, so that rendering needs no further samples for it. Between voxels \
             the gradients are interpolated.",
        )
        .input(volume)
        .output(result)
        .property(
            PropertyDecl::int("channel", "Channel", 0)
                .int_range(0, 3)
                .help("The channel of the volume to take, counted from 0."),
        )
        .property(
            PropertyDecl::choice("operator", "Operator", "central", operators).help("How gradients are estimated."),
        )
        .property(
            PropertyDecl::choice("storage", "Storage", "32-bit", storages)
                .help("How the result is held on the graphics device."),
        )
}

/// Computes the gradients.
pub fn process(context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
    let volume = &job.volume("volume")?.volume;
    let channel = job.properties.int("channel")?;
    let channel = u32::try_from(channel).ok().filter(|&channel| channel < volume.channels).ok_or_else(|| {
        let has = volume.channels;
        ProcessError::new(format!(
            "channel {channel} was chosen, but the volume `{}` has {has}; choose a smaller one",
            volume.name
        ))
    })?;
    let operator = match job.properties.text("operator")? {
        "sobel" => Operator::Sobel,
        _ => Operator::CentralDifferences,
    };
    let storage = Precision::from_id(job.properties.text("storage")?);
    let gradients = gradient_volume(volume, channel, operator)?;
    Ok(outputs_of(context, "gradients", Arc::new(gradients), storage))
}
