"""A contract for import-linter: what lies in a room of the package is imported from the room itself."""

from __future__ import annotations

from typing import Any

from importlinter import Contract, ContractCheck, fields, output


class FrontDoors(Contract):
    """Modules within a room, such as ``acausal.data.record``, are imported by modules of that room alone.

    ``free`` names the rooms that all may look into.
    """

    type_name = "front_doors"
    free = fields.SetField(subfield=fields.StringField(), required=False, default=set())

    def check(self, graph: Any, verbose: bool) -> ContractCheck:
        """Find the imports past a front door."""
        (root,) = self.session_options["root_packages"]
        passed = [
            (importer, imported)
            for importer in sorted(graph.modules)
            for imported in sorted(graph.find_modules_directly_imported_by(importer))
            if _is_past(imported.split("."), importer.split("."), root, self.free)
        ]
        return ContractCheck(kept=not passed, metadata={"passed": passed})

    def render_broken_contract(self, check: ContractCheck) -> None:
        """Print them."""
        for importer, imported in check.metadata["passed"]:
            room = ".".join(imported.split(".")[:2])
            output.print_error(f"{importer} imports {imported}: let it import from {room}.")


def _is_past(imported: list[str], importer: list[str], root: str, free: set[str]) -> bool:
    inside = imported[0] == root and len(imported) > 2 and imported[1] not in free
    return inside and importer[:2] != imported[:2]
