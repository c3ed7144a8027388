"""Maps of robots that have seen a part of a world."""

from dataclasses import replace

from topomap.topological_map import Length, TopologicalMap, Vertex


def part(chart, start, size, turn, sigma, rng):
    """Return what a robot knows that has seen `size` vertices from `start` on."""
    near = {v.id: [] for v in chart.vertices}
    for edge in chart.edges:
        near[edge.source].append(edge.target)
        near[edge.target].append(edge.source)
    seen = [start]
    for vertex in seen:
        seen += [v for v in sorted(near[vertex]) if v not in seen]
        if len(seen) >= size:
            break
    seen = seen[:size]
    edges = [e for e in chart.edges if e.source in seen and e.target in seen]
    vertices = []
    for vertex in chart.vertices:
        if vertex.id not in seen:
            continue
        used = [e.source_exit for e in edges if e.source == vertex.id]
        used += [e.target_exit for e in edges if e.target == vertex.id]
        free = tuple(x for x in vertex.exits if all(abs(x - y) > 0.01 for y in used))
        vertices.append(
            Vertex(
                vertex.id,
                vertex.type,
                tuple(x + turn for x in vertex.exits),
                tuple(x + turn for x in free),
            )
        )
    turned = [
        replace(
            edge,
            source_exit=edge.source_exit + turn,
            target_exit=edge.target_exit + turn,
            lengths=(measured(edge.fused.value, sigma, rng),),
        )
        for edge in edges
    ]
    return TopologicalMap(tuple(vertices), tuple(turned), chart.parameters)


def measured(value, sigma, rng):
    seen = value * (1 + sigma * rng.standard_normal())
    return Length(seen, sigma * seen)
