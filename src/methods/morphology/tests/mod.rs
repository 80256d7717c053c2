pub(crate) mod published;
