//! Rigorous integration: against integrals that are known in closed form, by their relations, and where it must give up.
