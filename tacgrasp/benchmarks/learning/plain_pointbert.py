"""PointBERT written plainly in torch's own layers, to time our encoder against; nothing trains it.

As ULIP-2's code has it: farthest points one by one, a nearest-neighbour search over the sorted
distances, a PointNet of 1 × 1 convolutions with batch normalisation over every group, positions
added in every layer, post-processing by class token and maximum.

Source: Yu et al., Point-BERT, 2022, section 3; Xue et al., ULIP-2, 2023. Our own code.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from cltp.encoder.encoder import EncoderConfig


class PlainPointBert(nn.Module):
    """The reference at the sizes of an encoder of ours.

    Args:
        config: Width, layers, heads, groups, width of the PointNet and of the feature.
    """

    def __init__(self, config: EncoderConfig) -> None:
        super().__init__()
        dim, width = config.dim, config.stem_dim
        self.config = config
        self.first = nn.Sequential(
            nn.Conv1d(3, width, 1), nn.BatchNorm1d(width), nn.ReLU(), nn.Conv1d(width, 2 * width, 1)
        )
        self.second = nn.Sequential(
            nn.Conv1d(4 * width, 2 * dim, 1),
            nn.BatchNorm1d(2 * dim),
            nn.ReLU(),
            nn.Conv1d(2 * dim, dim, 1),
        )
        self.position = nn.Sequential(nn.Linear(3, 128), nn.GELU(), nn.Linear(128, dim))
        self.cls = nn.Parameter(torch.zeros(1, 1, dim))
        self.cls_position = nn.Parameter(torch.randn(1, 1, dim))
        self.layers = nn.ModuleList(
            nn.TransformerEncoderLayer(
                dim,
                config.heads,
                4 * dim,
                dropout=0.0,
                activation="gelu",
                batch_first=True,
                norm_first=True,
            )
            for _ in range(config.depth)
        )
        self.norm = nn.LayerNorm(dim)
        self.feature = nn.Linear(2 * dim, config.feature_dim, bias=False)

    def forward(self, points: Tensor) -> Tensor:
        """Features (B, F) of points (B, N, 3)."""
        groups, centres = self.groups(points)
        batch, num, size, _ = groups.shape
        local = self.first(groups.reshape(batch * num, size, 3).transpose(1, 2))
        whole = local.max(dim=2, keepdim=True)[0].expand(-1, -1, size)
        tokens = self.second(torch.cat([whole, local], dim=1)).max(dim=2)[0].view(batch, num, -1)
        x = torch.cat([self.cls.expand(batch, -1, -1), tokens], dim=1)
        at = torch.cat([self.cls_position.expand(batch, -1, -1), self.position(centres)], dim=1)
        for layer in self.layers:
            x = layer(x + at)
        x = self.norm(x)
        found: Tensor = self.feature(torch.cat([x[:, 0], x[:, 1:].max(dim=1)[0]], dim=1))
        return found

    def groups(self, points: Tensor) -> tuple[Tensor, Tensor]:
        """Nearest points around farthest ones, relative (B, G, n, 3), and centres (B, G, 3)."""
        batch, count, _ = points.shape
        rows = torch.arange(batch)
        chosen = torch.zeros(batch, self.config.num_groups, dtype=torch.long)
        distance = torch.full((batch, count), 1e10)
        farthest = torch.randint(0, count, (batch,))
        for step in range(self.config.num_groups):
            chosen[:, step] = farthest
            centre = points[rows, farthest][:, None]
            distance = torch.minimum(distance, ((points - centre) ** 2).sum(-1))
            farthest = distance.max(-1)[1]
        centres = points[rows[:, None], chosen]
        apart = ((centres[:, :, None] - points[:, None]) ** 2).sum(-1)
        near = apart.sort(dim=-1)[1][:, :, : self.config.group_size]
        return points[rows[:, None, None], near] - centres[:, :, None], centres
